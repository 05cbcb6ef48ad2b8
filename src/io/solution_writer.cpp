#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

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

template <typename Item, typename Convert>
Json array(const std::vector<Item>& items, Convert convert) {
  Json result = Json::array();
  for (const Item& item : items) result.push_back(convert(item));
  return result;
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

Json marginals_of(const Marginals& marginals) {
  return {{"cost_per_nat", number(marginals.cost_per_nat)},
          {"num_proven", marginals.num_proven},
          {"weights", numbers(marginals.weights)},
          {"arcs", array(marginals.arcs, arc_marginal)},
          {"pairs", array(marginals.pairs, pair_marginal)},
          {"alone", array(marginals.alone, numbers)},
          {"ambiguous", array(marginals.ambiguous, ambiguous_index)}};
}

std::string one_line(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string list_text(const Json& list, const std::string& indent) {
  if (list.empty() || !list.front().is_structured()) return one_line(list);
  std::string result = "[";
  for (const Json& element : list) {
    result += (result.size() > 1 ? ",\n  " : "\n  ") + indent + one_line(element);
  }
  return result + "\n" + indent + "]";
}

// Fields a line each; of the objects among them only the marginals are that large.
std::string object_text(const Json& object, const std::string& indent) {
  const std::string inner = indent + "  ";
  std::string result = "{";
  for (const auto& field : object.items()) {
    const Json& value = field.value();
    result += (result.size() > 1 ? ",\n" : "\n") + inner + "\"" + field.key() + "\": ";
    result += value.is_array()             ? list_text(value, inner)
              : field.key() == "marginals" ? object_text(value, inner)
                                           : one_line(value);
  }
  return result + "\n" + indent + "}";
}

}  // namespace

std::string solution_to_json(const Solution& solution) {
  Json document = {{"format", "nda-solution"},
                   {"version", 1},
                   {"instance", instance(solution)},
                   {"status", to_string(solution.status)},
                   {"proven", solution.proven},
                   {"reason", solution.reason},
                   {"cost", number(solution.cost)},
                   {"lower_bound", number(solution.lower_bound)},
                   {"gap", number(solution.gap())},
                   {"relative_gap", number(solution.relative_gap())},
                   {"solutions", array(solution.solutions, ranked_solution)},
                   {"multipliers", array(solution.multipliers, numbers)},
                   {"cuts", Json::array()},
                   {"components", array(solution.components, component)},
                   {"stats", stats(solution.stats)}};
  if (solution.lists_all) document["lists_all"] = true;
  if (solution.marginals) document["marginals"] = marginals_of(*solution.marginals);
  return object_text(document, "") + "\n";
}

}  // namespace nda
