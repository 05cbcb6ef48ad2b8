#pragma once

#include <optional>
#include <string>
#include <vector>

namespace nda::mip {

/// What the caller knows of the machine; the library itself does not read the environment.
struct Surroundings {
  std::string search_path;                ///< folders of programs, separated by ':' (PATH)
  std::string temporary_folder = "/tmp";  ///< where temporary files go
};

/// Every executable file of this name, in the order of the path, each once; with its folder.
std::vector<std::string> find_programs(const std::string& name, const std::string& search_path);

/// The first of them.
std::optional<std::string> find_program(const std::string& name, const std::string& search_path);

}  // namespace nda::mip
