#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda::kbest {

/// Numbers the real indices of all dimensions from 0 on, as they follow each other.
class IndexNumbers {
 public:
  explicit IndexNumbers(std::span<const Index> sizes) {
    for (const Index size : sizes) first_.push_back(first_.back() + size);
  }
  std::size_t count() const { return first_.back(); }
  std::size_t operator()(std::size_t k, Index i) const { return first_[k] + i - 1; }

  /// Calls note(number) for the real indices of a tuple, in the order of its dimensions.
  template <typename Note>
  void for_each(std::span<const Index> tuple, Note&& note) const {
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      if (tuple[k] != 0) note((*this)(k, tuple[k]));
    }
  }

 private:
  std::vector<std::size_t> first_ = {0};
};

}  // namespace nda::kbest
