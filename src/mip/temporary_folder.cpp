#include "mip/temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "nda/types.hpp"

namespace nda::mip {

TemporaryFolder::TemporaryFolder(const std::string& parent) : path_(parent + "/nda-XXXXXX") {
  if (mkdtemp(path_.data()) == nullptr) {
    throw InputError(parent + ": cannot make a temporary folder: " + std::strerror(errno));
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace nda::mip
