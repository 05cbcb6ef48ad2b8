#pragma once

#include <cstddef>
#include <functional>
#include <utility>

namespace nda::core {

/// Whoever does several things at once for algorithms that know nothing of threads: work(i) for
/// every i < count, in any order, perhaps at once; returns when all have.  By itself one after the
/// other.  The things must share nothing that one of them writes.
class ForAll {
 public:
  using Run =
      std::function<void(std::size_t count, const std::function<void(std::size_t i)>& work)>;

  ForAll() = default;
  explicit ForAll(Run run) : run_(std::move(run)) {}

  void operator()(std::size_t count, const std::function<void(std::size_t i)>& work) const {
    if (run_ && count > 1) return run_(count, work);
    for (std::size_t i = 0; i < count; ++i) work(i);
  }

 private:
  Run run_;
};

}  // namespace nda::core
