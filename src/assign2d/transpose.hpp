#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/side.hpp"

namespace nda::lap {

/// The columns of a sparsity pattern, remembered until another pattern comes.
///
/// A dual loop changes costs and keeps the pattern: comparing it with the remembered one is an
/// order of magnitude cheaper than sorting it again.
class Transpose {
 public:
  /// Room for problems of so many pairs and members.
  void reserve(std::size_t num_pairs, std::size_t num_members);

  /// The problem by columns, rows ascending.  Valid until the next call and while `problem` lives.
  /// O(A + n) with a small constant for the remembered pattern.
  ColumnView view(const Assign2dProblem& problem);

 private:
  bool remembers(const Assign2dProblem& problem) const;
  void rebuild(const Assign2dProblem& problem);

  std::vector<std::uint32_t> row_start_;
  std::vector<std::uint32_t> column_;
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> row_;
  std::vector<std::uint32_t> entry_;
};

}  // namespace nda::lap
