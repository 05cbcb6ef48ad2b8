#include "mip/programs.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace nda::mip {
namespace {

bool is_program(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::vector<std::string> find_programs(const std::string& name, const std::string& search_path) {
  std::vector<std::string> found;
  std::istringstream folders(search_path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string path = folder + "/" + name;
    // A child works in another folder, where relative names would mean something else.
    const bool absolute = !folder.empty() && folder.front() == '/';
    if (absolute && is_program(path) && std::find(found.begin(), found.end(), path) == found.end())
      found.push_back(path);
  }
  return found;
}

std::optional<std::string> find_program(const std::string& name, const std::string& search_path) {
  const std::vector<std::string> found = find_programs(name, search_path);
  if (found.empty()) return std::nullopt;
  return found.front();
}

}  // namespace nda::mip
