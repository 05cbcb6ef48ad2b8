#include "cli/print_marginals.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cli/print.hpp"

namespace nda::cli {
namespace {

constexpr std::size_t kShownLines = 20;  // indices, arcs
constexpr std::size_t kShownUses = 5;    // of an index

// What an index is used for, and the weight of that.
using Use = std::pair<double, std::string>;

std::string text_of(const std::vector<Index>& arc) {
  std::string text;
  for (const Index i : arc) {
    if (!text.empty()) text += ' ';
    text += std::to_string(i);
  }
  return text;
}

std::size_t num_shown(std::size_t count, std::size_t most, bool all) {
  return all ? count : std::min(count, most);
}

void print_rest(std::size_t count, std::size_t shown, const char* what) {
  if (shown < count) print("%10s and %zu more %s\n", "...", count - shown, what);
}

// Greatest weight first.
std::vector<Use> uses_of(const AmbiguousIndex& index, const Marginals& marginals) {
  std::vector<Use> uses;
  for (const std::size_t a : index.arcs)
    uses.emplace_back(marginals.arcs[a].weight, text_of(marginals.arcs[a].arc));
  const double alone = marginals.alone[static_cast<std::size_t>(index.dimension)][index.index - 1];
  if (alone > 0) uses.emplace_back(alone, "alone");
  std::stable_sort(
      uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.first > b.first; });
  return uses;
}

void print_index(const AmbiguousIndex& index, const Marginals& marginals, bool all) {
  const std::vector<Use> uses = uses_of(index, marginals);
  const std::size_t shown = num_shown(uses.size(), kShownUses, all);
  print("%10d %9u %12.6g", index.dimension + 1, index.index, index.entropy);
  for (std::size_t n = 0; n < shown; ++n) {
    print("%*s %12.6g  %s\n", n == 0 ? 0 : 33, "", uses[n].first, uses[n].second.c_str());
  }
  if (shown < uses.size()) print("%*s %12s and %zu more\n", 33, "", "...", uses.size() - shown);
}

void print_ambiguous(const Marginals& marginals, bool all) {
  const std::size_t count = marginals.ambiguous.size();
  print("\n%10s %9s %12s %12s  %s\n", "dimension", "index", "entropy", "weight", "use");
  const std::size_t shown = num_shown(count, kShownLines, all);
  for (std::size_t n = 0; n < shown; ++n) print_index(marginals.ambiguous[n], marginals, all);
  print_rest(count, shown, "indices");
}

// Arcs that some of the ranks lack, greatest weight first.
std::vector<const ArcMarginal*> arcs_in_doubt(const Marginals& marginals) {
  std::vector<const ArcMarginal*> arcs;
  for (const ArcMarginal& arc : marginals.arcs) {
    if (arc.weight > 0 && arc.weight < 1) arcs.push_back(&arc);
  }
  std::stable_sort(arcs.begin(), arcs.end(), [](const ArcMarginal* a, const ArcMarginal* b) {
    return a->weight > b->weight;
  });
  return arcs;
}

void print_arcs(const std::vector<const ArcMarginal*>& arcs, bool all) {
  print("\n%10s  %s\n", "weight", "arc in doubt");
  const std::size_t shown = num_shown(arcs.size(), kShownLines, all);
  for (std::size_t n = 0; n < shown; ++n)
    print("%10.6g  %s\n", arcs[n]->weight, text_of(arcs[n]->arc).c_str());
  print_rest(arcs.size(), shown, "arcs");
}

}  // namespace

void print_marginals(const Solution& solution, double seconds, bool all) {
  const Marginals& marginals = *solution.marginals;
  const std::size_t ranks = marginals.weights.size();
  if (ranks == 0) return;
  if (solution.lists_all) {
    print("\nmarginals     exact: there is no solution but these\n");
  } else {
    print(
        "\nmarginals     if the truth is one of these ranks; %zu of %zu proven, the last weighs "
        "%.3g\n",
        marginals.num_proven,
        ranks,
        marginals.weights.back());
  }
  std::size_t indices = 0;
  for (const std::vector<double>& row : marginals.alone) indices += row.size();
  const std::vector<const ArcMarginal*> in_doubt = arcs_in_doubt(marginals);
  print("ambiguous     %zu of %zu indices; %zu of %zu arcs are in doubt\n",
        marginals.ambiguous.size(),
        indices,
        in_doubt.size(),
        marginals.arcs.size());
  print("took          %.4f s\n", seconds);
  if (!marginals.ambiguous.empty()) print_ambiguous(marginals, all);
  if (!in_doubt.empty()) print_arcs(in_doubt, all);
}

}  // namespace nda::cli
