#include <cstdint>
#include <limits>

#include "generate/parameters.hpp"
#include "generate/portable.hpp"
#include "nda/generate.hpp"

// The two random families of the AFOSR report, section 5.  The report gives N, the average sizes,
// the range of the costs and the share of tuples; what it leaves open is settled as follows.
// Figure 5.1 counts "free variables": taken as tuples of real indices.  In figure 5.3 "25 % of arcs
// feasible" is taken as a share of all tuples with two or more real indices, dummies included, and
// every index has a singleton.

namespace nda {
namespace {

using generate::Draw;
using generate::Micro;

Micro draw_cost(Draw& draw, int low, int high) {
  return draw.integer(low * generate::kMicrosPerUnit, high * generate::kMicrosPerUnit);
}

// The tuple with this number in lexicographic order; index k runs over `choices[k]` values from
// `first`.
void decode(std::uint64_t code,
            const std::vector<Index>& sizes,
            Index first,
            std::vector<Index>& tuple) {
  for (std::size_t k = sizes.size(); k-- > 0;) {
    const std::uint64_t choices = sizes[k] + std::uint64_t{1} - first;
    tuple[k] = first + static_cast<Index>(code % choices);
    code /= choices;
  }
}

int num_real(const std::vector<Index>& tuple) {
  int count = 0;
  for (const Index i : tuple) count += i != 0;
  return count;
}

void add_singletons(Draw& draw, ProblemBuilder& builder, const std::vector<Index>& sizes) {
  std::vector<Index> tuple(sizes.size(), 0);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    for (Index i = 1; i <= sizes[k]; ++i) {
      tuple[k] = i;
      builder.add_arc(tuple, generate::from_micro(draw_cost(draw, 1, 100)));
    }
    tuple[k] = 0;
  }
}

// Tuples of the product of 0..M_k with two or more real indices.
std::uint64_t count_arcs(const std::vector<Index>& sizes) {
  std::uint64_t count = generate::count_tuples(sizes, true, 30) - 1;
  for (const Index size : sizes) count -= size;
  return count;
}

}  // namespace

Instance generate_poore_sparse(const PooreSparseOptions& options) {
  generate::require_ranges(options);
  const double num_arcs = static_cast<double>(options.arcs);
  generate::require_moderate(options.dimensions, options.max_size, num_arcs);
  Draw draw(options.seed);
  const std::vector<Index> sizes =
      generate::draw_sizes(draw, options.dimensions, options.min_size, options.max_size);
  const std::uint64_t total = generate::count_tuples(sizes, false, 62);
  generate::require(options.arcs <= total, "arcs", num_arcs, "more than there are tuples");
  ProblemBuilder builder(sizes);
  builder.reserve(options.arcs);
  std::vector<Index> tuple(sizes.size());
  for (const std::uint64_t code : draw.distinct(options.arcs, total)) {
    decode(code, sizes, 1, tuple);
    builder.add_arc(tuple, generate::from_micro(draw_cost(draw, -100, -1)));
  }
  return {std::move(builder).build(),
          {generate::Parameters("poore-5.1", options).command()},
          std::nullopt};
}

Instance generate_poore_dense(const PooreDenseOptions& options) {
  generate::require_ranges(options);
  generate::require_moderate(options.dimensions, options.max_size, 0);
  Draw draw(options.seed);
  const std::vector<Index> sizes =
      generate::draw_sizes(draw, options.dimensions, options.min_size, options.max_size);
  std::uint64_t left = count_arcs(sizes);
  std::uint64_t wanted = static_cast<std::uint64_t>(options.share * static_cast<double>(left));
  generate::require_moderate(options.dimensions, 0, static_cast<double>(wanted));
  ProblemBuilder builder(sizes);
  builder.reserve(wanted);
  add_singletons(draw, builder, sizes);
  std::vector<Index> tuple(sizes.size());
  for (std::uint64_t code = 0; wanted > 0; ++code) {
    decode(code, sizes, 0, tuple);
    if (num_real(tuple) < 2) continue;
    if (draw.below(left--) >= wanted) continue;
    --wanted;
    builder.add_arc(tuple, generate::from_micro(draw_cost(draw, 1, 100)));
  }
  return {std::move(builder).build(),
          {generate::Parameters("poore-5.3", options).command()},
          std::nullopt};
}

}  // namespace nda
