#pragma once

#include <algorithm>

namespace nda::core {

/// For work that may be in vain and is tried again and again: less and less often while it fails.
class Pause {
 public:
  /// @param longest  times that are left out in a row at most.
  explicit Pause(int longest) : longest_(longest) {}

  /// Whether to leave it out this time.
  bool skip() {
    if (left_ == 0) return false;
    --left_;
    return true;
  }

  /// How a try ended.
  void note(bool success) {
    length_ = success ? 0 : std::min(2 * length_ + 1, longest_);
    left_ = length_;
  }

 private:
  int longest_;
  int length_ = 0;
  int left_ = 0;
};

}  // namespace nda::core
