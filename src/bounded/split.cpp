#include "bounded/split.hpp"

#include <algorithm>
#include <cmath>

#include "bounded/parts.hpp"
#include "core/double_double.hpp"
#include "core/fault_text.hpp"
#include "decompose/components.hpp"

// What a use of an index saves at most is its singleton where it must be used (lo > 0), else
// nothing.  This generalises the cost shift of the one-to-one problem, where it decides which arcs
// matter, too.

namespace nda::bounded {
namespace {

using core::ArcId;

constexpr double kArcsPerDimension = 16;

bool is_once(const UseBounds& bounds) {
  return bounds == UseBounds{};
}

// As asked for; an index whose singleton pays is left alone as often as it may be.
Row row_of(const Problem& problem, int k, Index i) {
  const UseBounds asked = problem.use_bounds(k, i);
  Row row;
  row.single = problem.singleton_costs(k)[i];
  row.lo = row.single < 0 ? asked.hi : asked.lo;
  row.hi = asked.hi;
  row.is_forced = row.single == kInfinity;
  return row;
}

class Splitter {
 public:
  Splitter(const Problem& problem, const core::Deadline& deadline)
      : problem_(problem), deadline_(deadline) {}

  Split run() {
    read_rows();
    keep_arcs();
    classify();
    if (!split_.infeasible.empty() || deadline_.reached()) return std::move(split_);
    const core::Component graph = couple();
    const decompose::Partition parts = decompose::partition(graph, deadline_);
    if (deadline_.reached()) return {};  // the partition may be cut short
    std::vector<ArcId> once;
    core::Cutter cutter;
    for (std::size_t p = 0; p < parts.num_components(); ++p) {
      if (deadline_.reached()) return {};
      const std::span<const ArcId> arcs = parts.component(p);
      if (has_bounds(graph, arcs)) {
        add_part(cutter.cut(graph, arcs));
      } else {
        once.insert(once.end(), arcs.begin(), arcs.end());
      }
    }
    make_rest(graph, once);
    return std::move(split_);
  }

 private:
  std::size_t num_dimensions() const { return problem_.sizes().size(); }
  Index index(std::size_t k, ArcId a) const { return problem_.indices(static_cast<int>(k))[a]; }

  void read_rows() {
    for (std::size_t k = 0; k < num_dimensions(); ++k) {
      std::vector<Row>& rows =
          rows_.emplace_back(problem_.size(static_cast<int>(k)) + std::size_t{1});
      for (Index i = 1; i < rows.size(); ++i) rows[i] = row_of(problem_, static_cast<int>(k), i);
      split_.charge.emplace_back(rows.size(), 0.0);
      split_.in_rest.emplace_back(rows.size(), 0);
      split_.alone.emplace_back(rows.size(), Split::kNoArc);
      couples_.emplace_back(rows.size(), 0);
    }
  }

  bool can_pay(ArcId a) const {
    core::DoubleDouble cost(problem_.costs()[a]);
    bool must = false;
    for (std::size_t k = 0; k < num_dimensions(); ++k) {
      const Index i = index(k, a);
      if (i == 0) continue;
      const Row& row = rows_[k][i];
      if (row.hi == 0) return false;
      if (row.lo == 0) continue;
      must = must || row.is_forced;
      if (!row.is_forced) cost.add(-row.single);
    }
    return must || cost.negative();
  }

  void keep_arcs() {
    for (const std::vector<Row>& rows : rows_) degree_.emplace_back(rows.size(), 0);
    for (ArcId a = 0; a < problem_.num_arcs(); ++a) {
      if (!can_pay(a)) continue;
      kept_.push_back(a);
      for (std::size_t k = 0; k < num_dimensions(); ++k) ++degree_[k][index(k, a)];
    }
  }

  // Which indices couple their arcs, and what the others charge for a use.
  void classify() {
    core::DoubleDouble constant;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      for (Index i = 1; i < rows_[k].size(); ++i) {
        Row& row = rows_[k][i];
        const Index degree = degree_[k][i];
        if (is_once(problem_.use_bounds(static_cast<int>(k), i))) {
          couples_[k][i] = 1;
          continue;
        }
        if (row.is_forced && row.lo > degree) return set_infeasible(k, i, degree);
        const bool is_linear = row.is_forced
                                   ? row.lo == 0 && row.hi >= degree
                                   : row.hi >= degree && (row.lo == 0 || row.lo >= degree);
        if (!is_linear) {
          couples_[k][i] = 1;
        } else if (row.lo > 0) {
          split_.charge[k][i] = row.single;
          constant.add(row.single * row.lo);
        }
      }
    }
    split_.constant = constant.high();
  }

  void set_infeasible(std::size_t k, Index i, Index degree) {
    if (!split_.infeasible.empty()) return;
    split_.infeasible = core::index_text(k, i) + " must be used " + std::to_string(rows_[k][i].lo) +
                        " times, and " + std::to_string(degree) +
                        (degree == 1 ? " arc contains it" : " arcs contain it");
  }

  // The kept arcs as one component, with 0 for every index that couples nothing.
  core::Component couple() {
    core::Component graph =
        core::make_component({problem_.sizes().begin(), problem_.sizes().end()});
    std::vector<Index> tuple(num_dimensions());
    for (const ArcId a : kept_) {
      core::DoubleDouble cost(problem_.costs()[a]);
      bool is_coupled = false;
      for (std::size_t k = 0; k < tuple.size(); ++k) {
        const Index i = index(k, a);
        tuple[k] = couples_[k][i] != 0 ? i : 0;
        is_coupled = is_coupled || tuple[k] != 0;
        if (tuple[k] == 0) cost.add(-split_.charge[k][i]);
      }
      if (is_coupled) {
        core::append_arc(graph, tuple, cost.high());
        graph.arc_origin.push_back(a);
      } else if (cost.negative()) {
        split_.taken.push_back(a);
        split_.taken_cost.push_back(cost.high());
      }
    }
    return graph;
  }

  bool has_bounds(const core::Component& graph, std::span<const ArcId> arcs) const {
    return std::any_of(arcs.begin(), arcs.end(), [&](ArcId a) {
      for (int k = 0; k < graph.num_dimensions(); ++k) {
        const Index i = graph.index(k, a);
        if (i != 0 && !is_once(problem_.use_bounds(k, i))) return true;
      }
      return false;
    });
  }

  void add_part(core::Component graph) {
    BoundedComponent part{std::move(graph), {}};
    part.rows.resize(part.graph.num_slots());
    core::for_each_index(part.graph, [&](std::uint32_t slot, std::size_t k, Index i) {
      part.rows[slot] = rows_[k][i];
      couples_[k][i] = 0;  // not of the rest
    });
    const std::vector<Index> degree = count_uses(part.graph, core::all_arcs(part.graph));
    for (std::size_t slot = 0; slot < part.rows.size(); ++slot) {
      Row& row = part.rows[slot];
      row.is_open = row.hi >= degree[slot];
      row.hi = std::min(row.hi, degree[slot]);
      row.lo = std::min(row.lo, row.hi);
    }
    set_modest_penalties(part);
    split_.parts.push_back(std::move(part));
  }

  // Arcs that have lost all indices but one are ways to leave that alone.
  void make_rest(const core::Component& graph, std::vector<ArcId>& arcs) {
    std::sort(arcs.begin(), arcs.end());
    ProblemBuilder builder({problem_.sizes().begin(), problem_.sizes().end()});
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      for (Index i = 1; i < rows_[k].size(); ++i) {
        if (couples_[k][i] == 0 || !is_once(problem_.use_bounds(static_cast<int>(k), i))) continue;
        split_.in_rest[k][i] = 1;
        std::vector<Index> alone(rows_.size(), 0);
        alone[k] = i;
        builder.add_arc(alone, rows_[k][i].single);
      }
    }
    for (const ArcId a : arcs) builder.add_arc(tuple_of(graph, a), graph.costs[a]);
    split_.rest.emplace(std::move(builder).build());
    find_origins(graph, arcs);
  }

  static std::vector<Index> tuple_of(const core::Component& graph, ArcId a) {
    std::vector<Index> tuple;
    for (int k = 0; k < graph.num_dimensions(); ++k) tuple.push_back(graph.index(k, a));
    return tuple;
  }

  // Of arcs that became the same, the cheapest; the rest has its cost.
  void find_origins(const core::Component& graph, std::span<const ArcId> arcs) {
    const Problem& rest = *split_.rest;
    split_.rest_arc.assign(rest.num_arcs(), Split::kNoArc);
    for (const ArcId a : arcs) {
      const std::vector<Index> tuple = tuple_of(graph, a);
      const double cost = graph.costs[a];
      if (const auto found = rest.find(tuple)) {
        if (rest.costs()[*found] == cost) split_.rest_arc[*found] = graph.arc_origin[a];
        continue;
      }
      const auto real = std::find_if(tuple.begin(), tuple.end(), [](Index i) { return i != 0; });
      const auto k = static_cast<std::size_t>(real - tuple.begin());
      const double left = rest.singleton_costs(static_cast<int>(k))[*real];
      if (cost == left && cost < rows_[k][*real].single)
        split_.alone[k][*real] = graph.arc_origin[a];
    }
  }

  const Problem& problem_;
  const core::Deadline& deadline_;
  Split split_;
  std::vector<std::vector<Row>> rows_;              // [k][i]: as asked for
  std::vector<std::vector<Index>> degree_;          // [k][i]: kept arcs
  std::vector<std::vector<std::uint8_t>> couples_;  // [k][i]
  std::vector<ArcId> kept_;
};

}  // namespace

Split split(const Problem& problem, const core::Deadline& deadline) {
  return Splitter(problem, deadline).run();
}

BoundedComponent whole_component(const Problem& problem, std::span<const ArcId> arcs) {
  BoundedComponent whole{core::make_component({problem.sizes().begin(), problem.sizes().end()}),
                         {}};
  whole.rows.resize(whole.graph.num_slots());
  std::vector<Index> tuple(problem.sizes().size());
  for (const ArcId a : arcs) {
    for (std::size_t k = 0; k < tuple.size(); ++k)
      tuple[k] = problem.indices(static_cast<int>(k))[a];
    core::append_arc(whole.graph, tuple, problem.costs()[a]);
  }
  whole.graph.arc_origin.assign(arcs.begin(), arcs.end());
  core::for_each_index(whole.graph, [&](std::uint32_t slot, std::size_t k, Index i) {
    whole.rows[slot] = row_of(problem, static_cast<int>(k), i);
  });
  fit_rows(whole);
  set_modest_penalties(whole);
  return whole;
}

double largest_cost(const BoundedComponent& component) {
  double largest = core::largest_cost(component.graph);
  for (const Row& row : component.rows) {
    if (!row.is_forced) largest = std::max(largest, std::abs(row.single));
  }
  return largest;
}

void set_modest_penalties(BoundedComponent& component) {
  const double largest = largest_cost(component);
  const double penalty =
      kArcsPerDimension * (component.graph.num_dimensions() + 1) * (largest > 0 ? largest : 1.0);
  for (Row& row : component.rows) {
    if (row.is_forced) row.single = penalty;
  }
}

void set_penalties_above(BoundedComponent& component, double cost) {
  core::DoubleDouble least;  // of all that may be chosen, penalties apart
  for (const double c : component.graph.costs) least.add(std::min(0.0, c));
  for (const Row& row : component.rows) {
    if (!row.is_forced) least.add(std::min(0.0, row.cost(0)));
  }
  const double range = cost - least.high();
  const double penalty = range + 0x1p-20 * (std::abs(range) + 1);
  for (Row& row : component.rows) {
    if (row.is_forced) row.single = penalty;
  }
}

}  // namespace nda::bounded
