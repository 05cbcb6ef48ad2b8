#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "nda/io.hpp"

// One line per field, and one per element where the elements are large, so that a solution can be
// read and compared by eye.  JSON has no infinity: it is written as the string "inf" or "-inf".

namespace nda {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

Json numbers(const std::vector<double>& values) {
  Json result = Json::array();
  for (const double value : values) result.push_back(number(value));
  return result;
}

Json instance(const Solution& solution) {
  return {{"dimensions", solution.sizes.size()},
          {"sizes", solution.sizes},
          {"arcs", solution.num_arcs},
          {"components", solution.num_components}};
}

Json ranked_solution(const RankedSolution& solution) {
  return {{"rank", solution.rank},
          {"cost", number(solution.cost)},
          {"proven", solution.proven},
          {"arcs", solution.arcs}};
}

Json component(const ComponentReport& report) {
  return {{"arcs", report.num_arcs},
          {"indices", report.num_indices},
          {"status", to_string(report.status)},
          {"proven", report.proven},
          {"cost", number(report.cost)},
          {"lower_bound", number(report.lower_bound)},
          {"method", report.method}};
}

Json reductions(const ReductionYield& yield) {
  return {{"components", yield.components},
          {"arcs", yield.arcs},
          {"outweighing", yield.outweighing},
          {"excluded", yield.excluded},
          {"redundant", yield.redundant},
          {"single", yield.single},
          {"unprofitable", yield.unprofitable},
          {"dominated", yield.dominated},
          {"sides", yield.sides},
          {"side_arcs", yield.side_arcs},
          {"left", yield.left}};
}

Json exchange(const ExchangeYield& yield) {
  return {{"arcs", yield.arcs},
          {"kept", yield.kept},
          {"excluded", yield.excluded},
          {"rounds", yield.rounds}};
}

Json fixing(const FixingYield& yield) {
  return {{"dropped", yield.dropped},
          {"taken", yield.taken},
          {"splits", yield.splits},
          {"parts", yield.parts}};
}

Json stats(const Stats& stats) {
  return {{"read_seconds", number(stats.read_seconds)},
          {"solve_seconds", number(stats.solve_seconds)},
          {"peak_memory_bytes", stats.peak_memory_bytes},
          {"dual_evaluations", stats.dual_evaluations},
          {"recoveries", stats.recoveries},
          {"nodes", stats.nodes},
          {"arcs_after_shift", stats.arcs_after_shift},
          {"arcs_after_fixing", stats.arcs_after_fixing},
          {"arcs_left", stats.arcs_left},
          {"tried_components", stats.tried_components},
          {"settled_components", stats.settled_components},
          {"reductions", reductions(stats.reductions)},
          {"forgotten_reductions", reductions(stats.forgotten_reductions)},
          {"exchange", exchange(stats.exchange)},
          {"branching", fixing(stats.branching)},
          {"searches", fixing(stats.searches)},
          {"certificate_bound", number(stats.certificate_bound)},
          {"bound_by_branching", stats.bound_by_branching}};
}

Json arc_marginal(const ArcMarginal& marginal) {
  return {{"arc", marginal.arc}, {"weight", number(marginal.weight)}};
}

// Dimensions count from 1 in files.
Json pair_marginal(const PairMarginal& pair) {
  return {{"first", Json::array({pair.first_dimension + 1, pair.first})},
          {"second", Json::array({pair.second_dimension + 1, pair.second})},
          {"weight", number(pair.weight)}};
}

Json ambiguous_index(const AmbiguousIndex& index) {
  return {{"dimension", index.dimension + 1},
          {"index", index.index},
          {"entropy", number(index.entropy)},
          {"arcs", index.arcs}};
}

std::string one_line(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// An object as text, to which a list of any length adds no more than its own text.
class ObjectText {
 public:
  explicit ObjectText(std::string indent) : indent_(std::move(indent)) {}

  void add(const char* name, const Json& value) { begin(name) += one_line(value); }

  // An element a line.
  template <typename Item, typename Convert>
  void add_list(const char* name, const std::vector<Item>& items, Convert convert) {
    std::string& text = begin(name) += "[";
    for (const Item& item : items) {
      text += &item == &items.front() ? "\n    " : ",\n    ";
      text += indent_;
      text += one_line(convert(item));
    }
    text += items.empty() ? "]" : "\n  " + indent_ + "]";
  }

  void add_object(const char* name, const std::string& text) { begin(name) += text; }

  std::string end() { return std::move(text_) + "\n" + indent_ + "}"; }

 private:
  std::string& begin(const char* name) {
    text_ += text_.size() > 1 ? ",\n  " : "\n  ";
    return text_ += indent_ + "\"" + name + "\": ";
  }

  std::string indent_;
  std::string text_ = "{";
};

std::string marginals_text(const Marginals& marginals) {
  ObjectText text("  ");
  text.add("cost_per_nat", number(marginals.cost_per_nat));
  text.add("num_proven", marginals.num_proven);
  text.add("weights", numbers(marginals.weights));
  text.add_list("arcs", marginals.arcs, arc_marginal);
  text.add_list("pairs", marginals.pairs, pair_marginal);
  text.add_list("alone", marginals.alone, numbers);
  text.add_list("ambiguous", marginals.ambiguous, ambiguous_index);
  return text.end();
}

}  // namespace

std::string solution_to_json(const Solution& solution) {
  ObjectText text("");
  text.add("format", "nda-solution");
  text.add("version", 1);
  text.add("instance", instance(solution));
  text.add("status", to_string(solution.status));
  text.add("proven", solution.proven);
  text.add("reason", solution.reason);
  text.add("cost", number(solution.cost));
  text.add("lower_bound", number(solution.lower_bound));
  text.add("gap", number(solution.gap()));
  text.add("relative_gap", number(solution.relative_gap()));
  text.add_list("solutions", solution.solutions, ranked_solution);
  text.add_list("multipliers", solution.multipliers, numbers);
  text.add("cuts", Json::array());
  text.add_list("components", solution.components, component);
  text.add("stats", stats(solution.stats));
  if (solution.lists_all) text.add("lists_all", true);
  if (solution.marginals) text.add_object("marginals", marginals_text(*solution.marginals));
  return text.end() + "\n";
}

}  // namespace nda
