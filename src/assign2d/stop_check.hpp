#pragma once

#include <cstddef>
#include <functional>

#include "nda/assign2d.hpp"

namespace nda::lap {

/// Asks the user now and then whether to go on.
class StopCheck {
 public:
  void set(const std::function<bool()>* stop) { stop_ = stop; }

  /// So many pairs are going to be looked at.  Throws Assign2dInterrupted when the user says stop.
  void spend(std::size_t pairs) {
    spent_ += pairs;
    if (spent_ < kPairsBetween) return;
    spent_ = 0;
    if (stop_ != nullptr && (*stop_)()) throw Assign2dInterrupted();
  }

 private:
  static constexpr std::size_t kPairsBetween = 50000;

  const std::function<bool()>* stop_ = nullptr;
  std::size_t spent_ = 0;
};

}  // namespace nda::lap
