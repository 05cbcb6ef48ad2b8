#include "generate/parameters.hpp"
#include "generate/portable.hpp"
#include "nda/generate.hpp"

// The dense axial assignment problem of Balas and Saltzman (1991) and Karapetyan's "Random" family:
// every tuple of real indices has an integer cost and everything must be covered.

namespace nda {
namespace {

void forbid_singletons(ProblemBuilder& builder, const Map3Options& options) {
  std::vector<Index> tuple(static_cast<std::size_t>(options.dimensions), 0);
  for (Index& index : tuple) {
    for (index = 1; index <= options.size; ++index) builder.add_arc(tuple, kInfinity);
    index = 0;
  }
}

// To the next tuple of real indices in lexicographic order; false after the last.
bool advance(std::vector<Index>& tuple, Index size) {
  for (std::size_t k = tuple.size(); k-- > 0;) {
    if (++tuple[k] <= size) return true;
    tuple[k] = 1;
  }
  return false;
}

}  // namespace

Instance generate_map3(const Map3Options& options) {
  generate::require_ranges(options);
  generate::require(options.max_cost >= options.min_cost,
                    "max_cost",
                    options.max_cost,
                    "must be at least min_cost, which is " + std::to_string(options.min_cost));
  const std::vector<Index> sizes(static_cast<std::size_t>(options.dimensions), options.size);
  const std::uint64_t num_arcs = generate::count_tuples(sizes, false, 30);
  generate::require_moderate(options.dimensions, options.size, static_cast<double>(num_arcs));
  ProblemBuilder builder(sizes);
  builder.reserve(num_arcs);
  forbid_singletons(builder, options);
  generate::Draw draw(options.seed);
  std::vector<Index> tuple(sizes.size(), 1);
  do {
    builder.add_arc(tuple, static_cast<double>(draw.integer(options.min_cost, options.max_cost)));
  } while (advance(tuple, options.size));
  return {
      std::move(builder).build(), {generate::Parameters("map3", options).command()}, std::nullopt};
}

}  // namespace nda
