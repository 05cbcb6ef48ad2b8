#include <functional>

#include "assign2d/dense_input.hpp"
#include "assign2d/ranking.hpp"
#include "assign2d/shortest_path.hpp"
#include "nda/assign2d_k_best.hpp"

namespace nda {
namespace {

// Solves the problem, then ranks; the problem must stay where it is.
class Lister {
 public:
  bool next(const Assign2dProblem& problem, Assign2dResult& result) {
    if (state_ == State::kFresh) start(problem);
    return state_ == State::kFeasible && ranking_.next(result);
  }

  void set_stop(const std::function<bool()>* stop) {
    stop_ = stop;
    ranking_.set_stop(stop);
  }

 private:
  enum class State { kFresh, kFeasible, kInfeasible };

  void start(const Assign2dProblem& problem) {
    Assign2dResult best;
    lap::ShortestPathSolver solver;
    solver.set_stop(stop_);
    solver.solve(problem, best);
    state_ = best.feasible ? State::kFeasible : State::kInfeasible;
    if (best.feasible) ranking_.start(problem, best);
  }

  const std::function<bool()>* stop_ = nullptr;
  State state_ = State::kFresh;
  lap::Ranking ranking_;
};

std::vector<Assign2dResult> first(const Assign2dProblem& problem, std::size_t k) {
  std::vector<Assign2dResult> results;
  Lister lister;
  for (Assign2dResult result; results.size() < k && lister.next(problem, result);) {
    results.push_back(std::move(result));
  }
  return results;
}

template <class T>
std::vector<T> copy(std::span<const T> values) {
  return {values.begin(), values.end()};
}

}  // namespace

class Assign2dRanking::Impl {
 public:
  explicit Impl(const Assign2dProblem& problem)
      : row_start_(copy(problem.row_start)),
        column_(copy(problem.column)),
        cost_(copy(problem.cost)),
        row_outside_(copy(problem.row_outside)),
        column_outside_(copy(problem.column_outside)) {}

  void set_stop(const std::function<bool()>* stop) { lister_.set_stop(stop); }

  bool next(Assign2dResult& result) {
    return lister_.next({row_start_, column_, cost_, row_outside_, column_outside_}, result);
  }

 private:
  std::vector<std::uint32_t> row_start_;
  std::vector<std::uint32_t> column_;
  std::vector<double> cost_;
  std::vector<double> row_outside_;
  std::vector<double> column_outside_;
  Lister lister_;
};

Assign2dRanking::Assign2dRanking(const Assign2dProblem& problem)
    : impl_(std::make_unique<Impl>(problem)) {}
Assign2dRanking::~Assign2dRanking() = default;
Assign2dRanking::Assign2dRanking(Assign2dRanking&& other) noexcept = default;
Assign2dRanking& Assign2dRanking::operator=(Assign2dRanking&& other) noexcept = default;

bool Assign2dRanking::next(Assign2dResult& result) {
  return impl_->next(result);
}

void Assign2dRanking::set_stop(const std::function<bool()>* stop) {
  impl_->set_stop(stop);
}

std::vector<Assign2dResult> assign2d_k_best(const Assign2dProblem& problem, std::size_t k) {
  validate(problem);
  return first(problem, k);
}

std::vector<Assign2dResult> assign2d_k_best(std::span<const double> cost_row_major,
                                            std::uint32_t num_rows,
                                            std::uint32_t num_columns,
                                            std::size_t k) {
  const lap::DenseInput input(cost_row_major, num_rows, num_columns);
  const lap::FullPattern pattern(num_rows, num_columns);
  return first(
      {pattern.row_start, pattern.column, input.cost, input.row_outside, input.column_outside}, k);
}

}  // namespace nda
