#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "mip/programs.hpp"
#include "mip/temporary_folder.hpp"

namespace nda::mip {

/// The folder for temporary files of a test; empty at first, and to be so at the end.
class Scratch {
 public:
  Scratch() : folder_(std::filesystem::temp_directory_path().string()) {}

  const std::string& path() const { return folder_.path(); }
  std::string file(const std::string& name) const { return folder_.file(name); }
  bool is_empty() const { return std::filesystem::is_empty(folder_.path()); }

  /// Puts a shell script there, as a program of that name.
  void add_program(const std::string& name, const std::string& script) const {
    std::ofstream(file(name)) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(file(name), std::filesystem::perms::owner_all);
  }

 private:
  TemporaryFolder folder_;
};

inline std::string real_path() {
  const char* path = std::getenv("PATH");
  return path == nullptr ? "/usr/bin:/bin" : path;
}

}  // namespace nda::mip
