#include "core/option_table.hpp"

#include <charconv>
#include <cstdio>
#include <type_traits>

// A row is made by number() or choice() from a function that leads from the options to the field,
// and from what the field may hold.

namespace nda::core {
namespace {

// More threads than any machine has cores: beyond that a typing error.
constexpr double kMostThreads = 1024;

constexpr double kMostSets = 64;

// Of partial branch and bound: more would not end.
constexpr double kMostBranches = 10000;

struct Limits {
  double least = 0;
  double most = kInfinity;
  bool least_excluded = false;

  // False for NaN.
  bool allow(double value) const {
    return (least_excluded ? value > least : value >= least) && value <= most;
  }
};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string rule_of(const char* kind, const Limits& limits) {
  if (limits.least_excluded) return std::string(kind) + " above " + short_text(limits.least);
  if (limits.most == kInfinity)
    return std::string(kind) + ", " + short_text(limits.least) + " or more";
  return std::string(kind) + " from " + short_text(limits.least) + " to " + short_text(limits.most);
}

template <typename T, typename Field>
OptionRow number(const char* name, Field field, const Limits& limits, const char* meaning) {
  OptionRow row{name, "", meaning, {}, {}, {}};
  row.rule = rule_of(std::is_integral_v<T> ? "a whole number" : "a number", limits);
  row.holds = [=](const Options& options) {
    return limits.allow(static_cast<double>(field(options)));
  };
  row.text = [=](const Options& options) {
    if constexpr (std::is_integral_v<T>) return std::to_string(field(options));
    return short_text(static_cast<double>(field(options)));
  };
  row.read = [=](const std::string& text, Options& options) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !limits.allow(static_cast<double>(value))) {
      return false;
    }
    field(options) = value;
    return true;
  };
  return row;
}

// `names` in the order of the enumerators.
template <typename T, typename Field>
OptionRow choice(const char* name,
                 Field field,
                 const std::vector<std::string>& names,
                 const char* meaning) {
  OptionRow row{name, "", meaning, {}, {}, {}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    row.rule += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
  }
  row.holds = [=](const Options& options) {
    return static_cast<std::size_t>(field(options)) < names.size();
  };
  row.text = [=](const Options& options) {
    const auto value = static_cast<std::size_t>(field(options));
    return value < names.size() ? names[value] : "number " + std::to_string(value);
  };
  row.read = [=](const std::string& text, Options& options) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != text) continue;
      field(options) = static_cast<T>(i);
      return true;
    }
    return false;
  };
  return row;
}

void add_general(std::vector<OptionRow>& rows) {
  rows.push_back(choice<Method>(
      "method",
      [](auto& options) -> auto& { return options.method; },
      {"auto", "relaxation", "exact"},
      "how a component is solved"));
  rows.push_back(number<double>(
      "time_limit_s",
      [](auto& options) -> auto& { return options.time_limit_s; },
      {0, kInfinity, true},
      "stop after so many seconds with the best so far"));
  rows.push_back(number<double>(
      "relative_gap",
      [](auto& options) -> auto& { return options.relative_gap; },
      {},
      "stop when (cost - bound) / |cost| is at most this; 0.01 = 1 %"));
  rows.push_back(number<int>(
      "num_threads",
      [](auto& options) -> auto& { return options.num_threads; },
      {0, kMostThreads},
      "0 = all cores; the answer does not depend on it"));
  rows.push_back(number<std::uint64_t>(
      "seed",
      [](auto& options) -> auto& { return options.seed; },
      {},
      "of the randomised searches"));
  rows.push_back(choice<bool>(
      "proof",
      [](auto& options) -> auto& { return options.proof; },
      {"false", "true"},
      "write down a proof of the bound"));
}

void add_kept_sets(std::vector<OptionRow>& rows) {
  rows.push_back(number<int>(
      "relaxation.kept_sets",
      [](auto& options) -> auto& { return options.relaxation.kept_sets; },
      {0, kMostSets},
      "sets that the relaxation keeps, of N at most N - 1; in two dimensions always both: the "
      "assignment"));
  rows.push_back(number<std::size_t>(
      "relaxation.kept_exact_arcs",
      [](auto& options) -> auto& { return options.relaxation.kept_exact_arcs; },
      {},
      "relaxed problems of three and more sets are solved exactly up to so many arcs"));
  rows.push_back(number<std::int64_t>(
      "relaxation.kept_nodes",
      [](auto& options) -> auto& { return options.relaxation.kept_nodes; },
      {},
      "nodes of such a search, each time"));
  rows.push_back(number<int>(
      "relaxation.kept_evaluations",
      [](auto& options) -> auto& { return options.relaxation.kept_evaluations; },
      {1},
      "evaluations of the dual function of those that are not"));
  rows.push_back(choice<bool>(
      "relaxation.two_first",
      [](auto& options) -> auto& { return options.relaxation.two_first; },
      {"false", "true"},
      "with three and more kept sets begin where the dual function of two is largest"));
  rows.push_back(choice<bool>(
      "relaxation.merit",
      [](auto& options) -> auto& { return options.relaxation.merit; },
      {"false", "true"},
      "guide nonsmooth steps by their bounds (the merit function), not by their best packings"));
  rows.push_back(choice<bool>(
      "relaxation.decompose",
      [](auto& options) -> auto& { return options.relaxation.decompose; },
      {"false", "true"},
      "split problems, relaxed problems and recovery problems into components"));
  const std::vector<std::string> orders = {
      "as_given", "largest_first", "most_conflicting_first", "probe"};
  rows.push_back(choice<SetOrder>(
      "relaxation.set_order",
      [](auto& options) -> auto& { return options.relaxation.set_order; },
      orders,
      "the order of the sets of a component, of which the first are kept"));
  rows.push_back(choice<SetOrder>(
      "relaxation.recovery_order",
      [](auto& options) -> auto& { return options.relaxation.recovery_order; },
      orders,
      "the same of a recovery problem"));
}

void add_relaxation(std::vector<OptionRow>& rows) {
  add_kept_sets(rows);
  rows.push_back(choice<DualMethod>(
      "relaxation.dual_method",
      [](auto& options) -> auto& { return options.relaxation.dual_method; },
      {"bundle", "subgradient", "volume", "coordinate"},
      "how the dual function is maximised"));
  rows.push_back(choice<Assign2dMethod>(
      "relaxation.assign2d",
      [](auto& options) -> auto& { return options.relaxation.assign2d; },
      {"shortest_path", "auction", "network_simplex"},
      "what evaluates the dual function"));
  rows.push_back(choice<RecoveryMethod>(
      "relaxation.recovery",
      [](auto& options) -> auto& { return options.relaxation.recovery; },
      {"recursive", "dual_greedy", "local_search"},
      "how a relaxed solution is made feasible"));
  rows.push_back(number<int>(
      "relaxation.max_evaluations",
      [](auto& options) -> auto& { return options.relaxation.max_evaluations; },
      {1},
      "evaluations of the dual function of each large component (auto: before a linear program at "
      "most max(50, indices / 25), with bounds on uses 30)"));
  rows.push_back(number<int>(
      "relaxation.recovery_evaluations",
      [](auto& options) -> auto& { return options.relaxation.recovery_evaluations; },
      {1},
      "the same of each lower-dimensional recovery problem"));
  rows.push_back(number<int>(
      "relaxation.recovery_interval",
      [](auto& options) -> auto& { return options.relaxation.recovery_interval; },
      {1},
      "recover at every so many evaluations, at every one in three dimensions, and at the best"));
  rows.push_back(number<double>(
      "relaxation.relative_tolerance",
      [](auto& options) -> auto& { return options.relaxation.relative_tolerance; },
      {},
      "stop when the predicted increase of the dual falls below"));
  rows.push_back(choice<AlignmentRule>(
      "relaxation.alignment",
      [](auto& options) -> auto& { return options.relaxation.alignment; },
      {"best_value", "least_violation"},
      "which index alignment is recovered from"));
  rows.push_back(number<int>(
      "relaxation.inner_evaluations",
      [](auto& options) -> auto& { return options.relaxation.inner_evaluations; },
      {},
      "evaluations of the dual function of each inner problem; 0 = no inner problem"));
}

void add_search_and_branch(std::vector<OptionRow>& rows) {
  rows.push_back(choice<Reductions>(
      "search.reductions",
      [](auto& options) -> auto& { return options.search.reductions; },
      {"none", "quick", "all"},
      "which reductions try to settle a component before anything else does"));
  rows.push_back(choice<bool>(
      "search.local_search",
      [](auto& options) -> auto& { return options.search.local_search; },
      {"false", "true"},
      "local search and neighbourhood search where bounds do not end it"));
  rows.push_back(choice<bool>(
      "search.dimensionwise",
      [](auto& options) -> auto& { return options.search.dimensionwise; },
      {"false", "true"},
      "with it: the dimensionwise move, where a good part of all tuples are arcs"));
  rows.push_back(number<int>(
      "search.kicks_per_index",
      [](auto& options) -> auto& { return options.search.kicks_per_index; },
      {},
      "of local search: random moves per index of the component"));
  rows.push_back(number<std::size_t>(
      "branch.exact_arcs",
      [](auto& options) -> auto& { return options.branch.exact_arcs; },
      {},
      "components of at most so many arcs are enumerated first"));
  rows.push_back(number<std::int64_t>(
      "branch.max_nodes",
      [](auto& options) -> auto& { return options.branch.max_nodes; },
      {},
      "nodes of branch and bound per component"));
  rows.push_back(number<int>(
      "branch.node_evaluations",
      [](auto& options) -> auto& { return options.branch.node_evaluations; },
      {1},
      "evaluations of the dual function at a node"));
  rows.push_back(number<std::size_t>(
      "branch.averaged_cuts_indices",
      [](auto& options) -> auto& { return options.branch.averaged_cuts_indices; },
      {},
      "components of at least so many indices get cuts in the Lagrangian dual before any linear "
      "program; 0 = all"));
}

void add_ranking(std::vector<OptionRow>& rows) {
  rows.push_back(choice<RankingMethod>(
      "ranking.method",
      [](auto& options) -> auto& { return options.ranking.method; },
      {"exact", "alignments", "murty"},
      "how the solutions after the first are found"));
  rows.push_back(number<int>(
      "ranking.branches",
      [](auto& options) -> auto& { return options.ranking.branches; },
      {1, kMostBranches},
      "of partial branch and bound: alignments followed at each stage"));
  rows.push_back(choice<bool>(
      "ranking.local_search",
      [](auto& options) -> auto& { return options.ranking.local_search; },
      {"false", "true"},
      "of partial branch and bound: improve what it finds by local search"));
}

}  // namespace

const std::vector<OptionRow>& option_table() {
  static const std::vector<OptionRow> table = [] {
    std::vector<OptionRow> rows;
    add_general(rows);
    add_relaxation(rows);
    add_search_and_branch(rows);
    add_ranking(rows);
    return rows;
  }();
  return table;
}

const OptionRow& find_option(const std::string& name) {
  for (const OptionRow& row : option_table()) {
    if (row.name == name) return row;
  }
  throw InputError("option '" + name + "' is not known");
}

void set_option(const std::string& name, const std::string& value, Options& options) {
  const OptionRow& row = find_option(name);
  if (row.read(value, options)) return;
  throw InputError("option " + name + " is '" + value + "', it must be " + row.rule);
}

}  // namespace nda::core
