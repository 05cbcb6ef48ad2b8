#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

#include "generate/portable.hpp"

namespace nda::generate {

/// Collects the command that makes a generated file again, its first comment.
class Parameters {
 public:
  Parameters(const std::string& family, std::uint64_t seed)
      : command_("nda generate " + family + " --seed " + std::to_string(seed)) {}

  void add(const char* name, const std::string& value) {
    command_ += std::string(" --") + name + " " + value;
  }
  void add(const char* name, double value) { add(name, decimal(to_micro(value))); }
  template <std::integral T>
  void add(const char* name, T value) {
    add(name, std::to_string(value));
  }

  const std::string& command() const { return command_; }

 private:
  std::string command_;
};

}  // namespace nda::generate
