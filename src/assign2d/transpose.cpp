#include "assign2d/transpose.hpp"

#include <algorithm>

// Counting sort: count per column, sum up, place.  Placing moves every start one column ahead, so
// the counts are stored one place further than they belong.

namespace nda::lap {

void Transpose::reserve(std::size_t num_pairs, std::size_t num_members) {
  for (std::vector<std::uint32_t>* list : {&column_, &row_, &entry_}) list->reserve(num_pairs);
  for (std::vector<std::uint32_t>* list : {&row_start_, &start_}) list->reserve(num_members + 2);
}

bool Transpose::remembers(const Assign2dProblem& problem) const {
  return start_.size() == problem.num_columns() + std::size_t{1} &&
         std::equal(problem.row_start.begin(),
                    problem.row_start.end(),
                    row_start_.begin(),
                    row_start_.end()) &&
         std::equal(problem.column.begin(), problem.column.end(), column_.begin(), column_.end());
}

void Transpose::rebuild(const Assign2dProblem& problem) {
  row_start_.assign(problem.row_start.begin(), problem.row_start.end());
  column_.assign(problem.column.begin(), problem.column.end());
  start_.assign(problem.num_columns() + std::size_t{2}, 0);
  row_.resize(column_.size());
  entry_.resize(column_.size());
  for (const std::uint32_t j : column_) ++start_[j + std::size_t{2}];
  for (std::size_t j = 2; j < start_.size(); ++j) start_[j] += start_[j - 1];
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    for (std::uint32_t k = row_start_[i]; k < row_start_[i + 1]; ++k) {
      const std::uint32_t place = start_[column_[k] + std::size_t{1}]++;
      row_[place] = i;
      entry_[place] = k;
    }
  }
  start_.pop_back();
}

ColumnView Transpose::view(const Assign2dProblem& problem) {
  if (!remembers(problem)) rebuild(problem);
  return {start_, row_, entry_, problem.cost};
}

}  // namespace nda::lap
