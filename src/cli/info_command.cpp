#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/print.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "nda/io.hpp"

namespace nda::cli {
namespace {

// Arcs by number of real indices.
void print_lengths(const Problem& problem) {
  std::map<int, std::size_t> count;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    int real = 0;
    for (int k = 0; k < problem.num_dimensions(); ++k) real += problem.indices(k)[a] != 0;
    ++count[real];
  }
  for (const auto& [real, arcs] : count) print("  of %2d indices       %zu\n", real, arcs);
}

void print_singletons(const Problem& problem) {
  std::size_t priced = 0;
  std::size_t forbidden = 0;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) {
      priced += cost != 0 && cost < kInfinity;
      forbidden += cost == kInfinity;
    }
  }
  print("singletons           %zu free, %zu priced, %zu forbidden\n",
        problem.num_indices() - priced - forbidden,
        priced,
        forbidden);
}

void print_bounds(const Problem& problem) {
  std::size_t bounded = 0;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) bounded += problem.use_bounds(k, i) != UseBounds{};
  }
  print("bounds on uses       %zu of %zu indices\n", bounded, problem.num_indices());
}

// Components by powers of ten of their arcs.
void print_components(const Problem& problem) {
  const core::Shift shift = core::make_shift(problem);
  const decompose::Partition partition = decompose::partition(problem, shift);
  print("after the cost shift %zu arcs in %zu components\n",
        partition.arcs.size(),
        partition.num_components());
  struct Row {
    std::size_t components = 0;
    std::size_t arcs = 0;
    std::size_t largest = 0;
  };
  std::map<std::size_t, Row> rows;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    const std::size_t arcs = partition.component(c).size();
    std::size_t decade = 1;
    while (decade * 10 <= arcs) decade *= 10;
    Row& row = rows[decade];
    ++row.components;
    row.arcs += arcs;
    row.largest = std::max(row.largest, arcs);
  }
  if (rows.empty()) return;
  print("%22s %11s %11s %11s\n", "arcs in component", "components", "arcs", "largest");
  for (const auto& [decade, row] : rows) {
    const std::string range = std::to_string(decade) + " .. " + std::to_string(decade * 10 - 1);
    print("%22s %11zu %11zu %11zu\n", range.c_str(), row.components, row.arcs, row.largest);
  }
}

int print_info(const std::string& file) {
  const Problem problem = read_problem(file);
  print("dimensions           %d\n", problem.num_dimensions());
  print("indices              %zu (", problem.num_indices());
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    print("%s%u", k > 0 ? " " : "", problem.size(k));
  }
  print(")\n");
  print("arcs                 %zu\n", problem.num_arcs());
  print_lengths(problem);
  if (problem.num_duplicates() > 0) {
    print("duplicates           %zu (the cheapest was kept)\n", problem.num_duplicates());
  }
  if (problem.num_forbidden() > 0) {
    print("forbidden arcs       %zu (cost inf, dropped)\n", problem.num_forbidden());
  }
  print_singletons(problem);
  const core::CostGrid grid = core::find_grid(problem);
  if (grid.step > 0) print("cost step            %g\n", grid.step);
  if (problem.is_many_to_one())
    print_bounds(problem);
  else
    print_components(problem);
  return kAnswer;
}

}  // namespace

Action declare_info(CLI::App& parser) {
  const auto file = std::make_shared<std::string>();
  parser.add_option("file", *file, "arc file, '-' for standard input")->required();
  parser.footer(
      "Sizes, arcs by number of real indices, singletons, and the connected components left when\n"
      "arcs that cannot beat their singletons are dropped; where indices have bounds on their "
      "uses,\n"
      "how many instead of the components.\n"
      "\n"
      "Example:\n"
      "  nda info window.nda.gz");
  return [file] { return print_info(*file); };
}

}  // namespace nda::cli
