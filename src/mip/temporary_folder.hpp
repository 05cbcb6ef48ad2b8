#pragma once

#include <string>

namespace nda::mip {

/// A new folder that only its owner can enter, removed with all it holds when the object dies.
class TemporaryFolder {
 public:
  /// @param parent  an existing folder.  Throws InputError when nothing can be made in it.
  explicit TemporaryFolder(const std::string& parent);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace nda::mip
