#include "cli/print_yields.hpp"

#include "cli/print.hpp"

namespace nda::cli {
namespace {

void print_rules(const ReductionYield& yield) {
  const auto line = [](std::size_t count, const char* what, std::size_t dropped) {
    if (count == 0) return;
    print("%14s%zu %s", "", count, what);
    print(dropped > 0 ? ", which dropped %zu more\n" : "\n", dropped);
  };
  line(yield.outweighing, "arcs that outweigh all they exclude", yield.excluded);
  line(yield.redundant, "redundant indices", 0);
  line(yield.single, "single choices", yield.unprofitable);
  line(yield.dominated, "dominated arcs", 0);
  line(yield.sides, "sides that hung on one index", yield.side_arcs);
}

void print_reductions(const Solution& solution) {
  const Stats& stats = solution.stats;
  print("\nreductions    settled %zu of %zu components, %zu tried\n",
        stats.settled_components,
        solution.num_components,
        stats.tried_components);
  print_rules(stats.reductions);
  const ReductionYield& forgotten = stats.forgotten_reductions;
  if (forgotten.components == 0) return;
  print("in vain       left %zu of %zu arcs of %zu components, which were solved whole\n",
        forgotten.left,
        forgotten.arcs,
        forgotten.components);
  print_rules(forgotten);
}

void print_exchange(const ExchangeYield& yield) {
  if (yield.rounds == 0) return;
  print("exchange      kept %zu and excluded %zu of %zu arcs in %d rounds of a hot start\n",
        yield.kept,
        yield.excluded,
        yield.arcs,
        yield.rounds);
}

void print_fixing(const char* where, const FixingYield& yield) {
  if (yield.dropped + yield.taken + yield.splits == 0) return;
  print("%-14sdropped %zu arcs and took %zu; %zu nodes fell into %zu parts\n",
        where,
        yield.dropped,
        yield.taken,
        yield.splits,
        yield.parts);
}

}  // namespace

void print_yields(const Solution& solution) {
  const Stats& stats = solution.stats;
  print_reductions(solution);
  print_exchange(stats.exchange);
  print(
      "fixing        left %zu of %zu arcs at first and %zu in the end, all of a component that "
      "ended without it\n",
      stats.arcs_after_fixing,
      stats.arcs_after_shift - stats.exchange.kept - stats.exchange.excluded,
      stats.arcs_left);
  print_fixing("branching", stats.branching);
  print_fixing("searches", stats.searches);
}

}  // namespace nda::cli
