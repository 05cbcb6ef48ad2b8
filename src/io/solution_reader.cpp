#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "io/json_node.hpp"
#include "io/scanner.hpp"
#include "nda/io.hpp"

namespace nda {
namespace {

using io::JsonNode;

constexpr std::uint64_t kMaxIndex = std::numeric_limits<Index>::max();
constexpr std::uint64_t kMaxCount = std::numeric_limits<std::int64_t>::max();
constexpr std::uint64_t kVersion = 1;

std::size_t count(const JsonNode& node) {
  return node.whole(kMaxCount);
}

Status status(const JsonNode& node) {
  constexpr std::array kAll = {Status::kOptimal,
                               Status::kGapReached,
                               Status::kTimeLimit,
                               Status::kIterationLimit,
                               Status::kNodeLimit,
                               Status::kInterrupted,
                               Status::kInfeasible,
                               Status::kPrecisionLost};
  for (const Status candidate : kAll) {
    if (node.text() == to_string(candidate)) return candidate;
  }
  node.fail("unknown status " + io::in_quotes(node.text()));
}

std::vector<Index> indices(const JsonNode& node) {
  std::vector<Index> result;
  result.reserve(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) {
    result.push_back(static_cast<Index>(node[i].whole(kMaxIndex)));
  }
  return result;
}

std::vector<double> numbers(const JsonNode& node) {
  std::vector<double> result;
  result.reserve(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) result.push_back(node[i].number());
  return result;
}

void read_instance(const JsonNode& node, Solution& solution) {
  solution.sizes = indices(node["sizes"]);
  const JsonNode dimensions = node["dimensions"];
  if (dimensions.whole(kMaxCount) != solution.sizes.size()) {
    dimensions.fail("differs from the number of sizes, " + std::to_string(solution.sizes.size()));
  }
  solution.num_arcs = count(node["arcs"]);
  solution.num_components = count(node["components"]);
}

std::vector<Index> arc(const JsonNode& node, std::size_t num_dimensions) {
  if (node.size() != num_dimensions) {
    node.fail("has " + std::to_string(node.size()) + " indices, expected " +
              std::to_string(num_dimensions));
  }
  return indices(node);
}

RankedSolution ranked_solution(const JsonNode& node, std::size_t num_dimensions) {
  RankedSolution result;
  result.rank = static_cast<int>(node["rank"].whole(std::numeric_limits<int>::max()));
  result.cost = node["cost"].number();
  result.proven = node["proven"].boolean();
  const JsonNode arcs = node["arcs"];
  for (std::size_t a = 0; a < arcs.size(); ++a) result.arcs.push_back(arc(arcs[a], num_dimensions));
  return result;
}

// From 0; files count from 1.
int dimension(const JsonNode& node, std::size_t num_dimensions) {
  const std::uint64_t number = node.whole(num_dimensions);
  if (number == 0) node.fail("dimensions count from 1");
  return static_cast<int>(number) - 1;
}

PairMarginal pair_marginal(const JsonNode& node, std::size_t num_dimensions) {
  PairMarginal result;
  const auto read = [&](const char* key, int& dimension_read, Index& index) {
    const JsonNode place = node[key];
    if (place.size() != 2) place.fail("expected a dimension and an index");
    dimension_read = dimension(place[std::size_t{0}], num_dimensions);
    index = static_cast<Index>(place[std::size_t{1}].whole(kMaxIndex));
  };
  read("first", result.first_dimension, result.first);
  read("second", result.second_dimension, result.second);
  result.weight = node["weight"].number();
  return result;
}

AmbiguousIndex ambiguous_index(const JsonNode& node, std::size_t num_dimensions) {
  AmbiguousIndex result;
  result.dimension = dimension(node["dimension"], num_dimensions);
  result.index = static_cast<Index>(node["index"].whole(kMaxIndex));
  result.entropy = node["entropy"].number();
  const JsonNode arcs = node["arcs"];
  for (std::size_t a = 0; a < arcs.size(); ++a) result.arcs.push_back(count(arcs[a]));
  return result;
}

Marginals marginals_of(const JsonNode& node, std::size_t num_dimensions) {
  Marginals result;
  result.cost_per_nat = node["cost_per_nat"].number();
  result.num_proven = count(node["num_proven"]);
  result.weights = numbers(node["weights"]);
  const JsonNode arcs = node["arcs"];
  for (std::size_t a = 0; a < arcs.size(); ++a)
    result.arcs.push_back({arc(arcs[a]["arc"], num_dimensions), arcs[a]["weight"].number()});
  const JsonNode pairs = node["pairs"];
  for (std::size_t p = 0; p < pairs.size(); ++p)
    result.pairs.push_back(pair_marginal(pairs[p], num_dimensions));
  const JsonNode alone = node["alone"];
  for (std::size_t k = 0; k < alone.size(); ++k) result.alone.push_back(numbers(alone[k]));
  const JsonNode ambiguous = node["ambiguous"];
  for (std::size_t i = 0; i < ambiguous.size(); ++i)
    result.ambiguous.push_back(ambiguous_index(ambiguous[i], num_dimensions));
  return result;
}

ComponentReport component(const JsonNode& node) {
  ComponentReport result;
  result.num_arcs = count(node["arcs"]);
  result.num_indices = count(node["indices"]);
  result.status = status(node["status"]);
  result.proven = node["proven"].boolean();
  result.cost = node["cost"].number();
  result.lower_bound = node["lower_bound"].number();
  result.method = node["method"].text();
  return result;
}

ReductionYield reductions(const JsonNode& node) {
  ReductionYield result;
  result.components = count(node["components"]);
  result.arcs = count(node["arcs"]);
  result.outweighing = count(node["outweighing"]);
  result.excluded = count(node["excluded"]);
  result.redundant = count(node["redundant"]);
  result.single = count(node["single"]);
  result.unprofitable = count(node["unprofitable"]);
  result.dominated = count(node["dominated"]);
  result.sides = count(node["sides"]);
  result.side_arcs = count(node["side_arcs"]);
  result.left = count(node["left"]);
  return result;
}

ExchangeYield exchange(const JsonNode& node) {
  ExchangeYield result;
  result.arcs = count(node["arcs"]);
  result.kept = count(node["kept"]);
  result.excluded = count(node["excluded"]);
  result.rounds = static_cast<int>(node["rounds"].whole(std::numeric_limits<int>::max()));
  return result;
}

FixingYield fixing(const JsonNode& node) {
  FixingYield result;
  result.dropped = count(node["dropped"]);
  result.taken = count(node["taken"]);
  result.splits = count(node["splits"]);
  result.parts = count(node["parts"]);
  return result;
}

// Files of before have none.
void read_yields(const JsonNode& node, Stats& stats) {
  if (!node.has("reductions")) return;
  stats.arcs_left = count(node["arcs_left"]);
  stats.tried_components = count(node["tried_components"]);
  stats.settled_components = count(node["settled_components"]);
  stats.reductions = reductions(node["reductions"]);
  stats.forgotten_reductions = reductions(node["forgotten_reductions"]);
  stats.exchange = exchange(node["exchange"]);
  stats.branching = fixing(node["branching"]);
  stats.searches = fixing(node["searches"]);
}

Stats stats(const JsonNode& node) {
  Stats result;
  result.read_seconds = node["read_seconds"].number();
  result.solve_seconds = node["solve_seconds"].number();
  result.peak_memory_bytes = count(node["peak_memory_bytes"]);
  result.dual_evaluations = static_cast<std::int64_t>(count(node["dual_evaluations"]));
  result.recoveries = static_cast<std::int64_t>(count(node["recoveries"]));
  result.nodes = static_cast<std::int64_t>(count(node["nodes"]));
  result.arcs_after_shift = count(node["arcs_after_shift"]);
  result.arcs_after_fixing = count(node["arcs_after_fixing"]);
  result.certificate_bound = node["certificate_bound"].number();
  result.bound_by_branching = node["bound_by_branching"].boolean();
  read_yields(node, result);
  return result;
}

void check_format(const JsonNode& root) {
  const JsonNode format = root["format"];
  if (format.text() != "nda-solution") {
    format.fail("expected 'nda-solution', found " + io::in_quotes(format.text()));
  }
  const JsonNode version = root["version"];
  if (version.whole(kMaxCount) != kVersion) {
    version.fail("version " + std::to_string(version.whole(kMaxCount)) +
                 " is not supported, only " + std::to_string(kVersion));
  }
}

// Both gaps follow from cost and bound, and must be theirs to 1e-9 of the larger of the two.
void require_gaps(const JsonNode& root, const Solution& solution) {
  const bool finite = std::isfinite(solution.gap());
  const double size =
      finite ? std::max(std::abs(solution.cost), std::abs(solution.lower_bound)) : 0.0;
  const auto require = [](const JsonNode& node, double right, double tolerance) {
    const double stated = node.number();
    if (stated == right || std::abs(stated - right) <= tolerance) return;
    node.fail("does not follow from cost and lower_bound");
  };
  require(root["gap"], solution.gap(), 1e-9 * size);
  require(root["relative_gap"],
          solution.relative_gap(),
          finite ? 1e-9 * size / std::max(1e-9, std::abs(solution.cost)) : 0.0);
}

Solution solution(const JsonNode& root) {
  check_format(root);
  Solution result;
  read_instance(root["instance"], result);
  result.status = status(root["status"]);
  result.proven = root["proven"].boolean();
  result.reason = root["reason"].text();
  result.cost = root["cost"].number();
  result.lower_bound = root["lower_bound"].number();
  require_gaps(root, result);
  const JsonNode solutions = root["solutions"];
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    result.solutions.push_back(ranked_solution(solutions[i], result.sizes.size()));
  }
  const JsonNode multipliers = root["multipliers"];
  for (std::size_t k = 0; k < multipliers.size(); ++k) {
    result.multipliers.push_back(numbers(multipliers[k]));
  }
  if (root["cuts"].size() != 0) root["cuts"].fail("cuts are not supported");
  const JsonNode components = root["components"];
  for (std::size_t i = 0; i < components.size(); ++i) {
    result.components.push_back(component(components[i]));
  }
  result.stats = stats(root["stats"]);
  result.lists_all = root.has("lists_all") && root["lists_all"].boolean();
  if (root.has("marginals"))
    result.marginals = marginals_of(root["marginals"], result.sizes.size());
  return result;
}

}  // namespace

Solution solution_from_json(std::string_view text) {
  const nlohmann::json document = io::parse_json(text);
  return solution(JsonNode(document));
}

}  // namespace nda
