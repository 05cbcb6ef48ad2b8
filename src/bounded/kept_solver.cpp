#include "bounded/kept_solver.hpp"

#include <algorithm>
#include <utility>

#include "bounded/bound.hpp"
#include "bounded/branch_and_bound.hpp"
#include "bounded/parts.hpp"
#include "bounded/recursive.hpp"
#include "bounded/split.hpp"
#include "core/double_double.hpp"

namespace nda::bounded {
namespace {

using core::ArcId;

// What bounds from a linear program can be relied on to reach, relative to the sum of all sizes.
double program_error(const BoundedComponent& part) {
  return 0x1p-43 * most_uses(part) * largest_cost(part);
}

class PartSearch {
 public:
  PartSearch(const BoundedComponent& part,
             const RelaxationOptions& options,
             const core::Deadline& deadline,
             std::vector<double> u)
      : part_(part), options_(options), deadline_(deadline), margin_(program_error(part)) {
    clamp(part, u);
    answer_.best = make_choice(part, {});
    answer_.lower = lagrangian_bound(part, u);
    answer_.u = std::move(u);
  }

  KeptAnswer run() {
    if (part_.graph.num_dimensions() <= 2 || part_.num_arcs() > options_.kept_exact_arcs) relax();
    if (!is_closed() && part_.num_arcs() <= options_.kept_exact_arcs) {
      search();
      if (!is_closed() && part_.graph.num_dimensions() > 2) relax();
    }
    answer_.exact = is_closed();
    return std::move(answer_);
  }

 private:
  bool is_closed() const { return answer_.best.cost - answer_.lower <= 2 * margin_; }

  void search() {
    const SearchLimits limits{margin_, 0, options_.kept_nodes, deadline_};
    SearchResult found = branch_and_bound(part_, answer_.best, answer_.u, limits, {});
    answer_.nodes += found.nodes;
    answer_.u = std::move(found.u);
    offer(std::move(found.best));
    answer_.lower = std::max(answer_.lower, found.lower);
  }

  void relax() {
    LagrangianOptions loop = loop_options(options_, deadline_);
    loop.max_evaluations = part_.graph.num_dimensions() <= 2 ? 1 : options_.kept_evaluations;
    loop.recovery_interval = part_.graph.num_dimensions() <= 3 ? 1 : 0;
    loop.margin = margin_;
    LagrangianResult found = maximize_dual(part_, answer_.u, loop, [&](const RelaxedDual& point) {
      return recover_recursively(part_, point, options_, deadline_);
    });
    answer_.evaluations += found.evaluations;
    answer_.nodes += found.nodes;
    offer(std::move(found.best));
    if (found.lower > answer_.lower) answer_.u = std::move(found.u);
    answer_.lower = std::max({answer_.lower, found.lower, found.kept_bound});
  }

  void offer(Choice choice) {
    if (choice.cost < answer_.best.cost) answer_.best = std::move(choice);
  }

  const BoundedComponent& part_;
  const RelaxationOptions& options_;
  const core::Deadline& deadline_;
  const double margin_;
  KeptAnswer answer_;
};

void solve(const BoundedComponent& problem,
           const RelaxationOptions& options,
           const core::Deadline& deadline,
           KeptAnswer& answer) {
  answer.u.resize(problem.rows.size(), 0.0);
  answer.exact = true;
  core::DoubleDouble lower(cost_without_arcs(problem));
  double error = 0x1p-52 * most_uses(problem) * largest_cost(problem);
  std::vector<ArcId> arcs;
  std::size_t seen = 0;
  for (const BoundedComponent& part : cut_parts(problem, deadline, options.decompose)) {
    const KeptAnswer found =
        PartSearch(
            part, options, deadline, core::restrict_slots(problem.graph, answer.u, part.graph))
            .run();
    seen += part.num_arcs();
    for (const ArcId a : found.best.arcs) arcs.push_back(part.graph.arc_origin[a]);
    core::extend_slots(part.graph, found.u, problem.graph, answer.u);
    lower.add(found.lower);
    answer.exact = answer.exact && found.exact;
    answer.evaluations += found.evaluations;
    answer.nodes += found.nodes;
  }
  answer.best = make_choice(problem, std::move(arcs));
  const bool complete = seen == problem.num_arcs();
  answer.exact = answer.exact && complete;
  answer.lower = complete ? lower.high() - error : -kInfinity;
}

}  // namespace

KeptSolver make_kept_solver(const RelaxationOptions& options, const core::Deadline& deadline) {
  return [options, deadline](const BoundedComponent& problem, KeptAnswer& answer) {
    solve(problem, options, deadline, answer);
  };
}

LagrangianOptions loop_options(const RelaxationOptions& options, const core::Deadline& deadline) {
  LagrangianOptions loop;
  loop.dual_method = options.dual_method;
  loop.relative_tolerance = options.relative_tolerance;
  loop.num_kept = options.kept_sets;
  loop.merit = options.merit;
  loop.deadline = deadline;
  if (options.kept_sets > 2) loop.solve = make_kept_solver(options, deadline);
  return loop;
}

}  // namespace nda::bounded
