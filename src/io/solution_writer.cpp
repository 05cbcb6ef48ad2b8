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

Json stats(const Stats& stats) {
  return {{"read_seconds", number(stats.read_seconds)},
          {"solve_seconds", number(stats.solve_seconds)},
          {"peak_memory_bytes", stats.peak_memory_bytes},
          {"dual_evaluations", stats.dual_evaluations},
          {"recoveries", stats.recoveries},
          {"nodes", stats.nodes},
          {"arcs_after_shift", stats.arcs_after_shift},
          {"arcs_after_fixing", stats.arcs_after_fixing},
          {"certificate_bound", number(stats.certificate_bound)},
          {"bound_by_branching", stats.bound_by_branching}};
}

template <typename Item, typename Convert>
Json array(const std::vector<Item>& items, Convert convert) {
  Json result = Json::array();
  for (const Item& item : items) result.push_back(convert(item));
  return result;
}

std::string one_line(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string text_of(const Json& value) {
  if (!value.is_array() || value.empty()) return one_line(value);
  std::string result = "[";
  for (const Json& element : value) {
    result += (result.size() > 1 ? ",\n    " : "\n    ") + one_line(element);
  }
  return result + "\n  ]";
}

}  // namespace

std::string solution_to_json(const Solution& solution) {
  const Json document = {{"format", "nda-solution"},
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
  std::string result = "{";
  for (const auto& field : document.items()) {
    result += (result.size() > 1 ? ",\n  \"" : "\n  \"") + field.key() + "\": ";
    result += text_of(field.value());
  }
  return result + "\n}\n";
}

}  // namespace nda
