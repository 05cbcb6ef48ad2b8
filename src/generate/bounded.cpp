#include <algorithm>
#include <string>
#include <vector>

#include "generate/parameters.hpp"
#include "generate/portable.hpp"
#include "nda/generate.hpp"

// Random arcs under random bounds on uses.  Singletons have finite costs that are not negative, so
// there is always a solution, and no use is ever without limit for gain.

namespace nda {
namespace {

using generate::Draw;

std::vector<Index> draw_tuple(Draw& draw, const BoundedOptions& options) {
  std::vector<Index> tuple(static_cast<std::size_t>(options.dimensions), 0);
  const auto real = [](Index i) { return i != 0; };
  while (std::count_if(tuple.begin(), tuple.end(), real) < 2) {
    for (Index& index : tuple) {
      const bool dummy = draw.uniform() < options.dummy_share;
      index = dummy ? 0 : static_cast<Index>(draw.integer(1, options.size));
    }
  }
  return tuple;
}

// One more than the most uses stands for no limit.
UseBounds draw_bounds(Draw& draw, const BoundedOptions& options) {
  const std::int64_t lo = draw.integer(0, options.max_uses);
  const std::int64_t hi = draw.integer(std::max<std::int64_t>(lo, 1), options.max_uses + 1);
  return {static_cast<Index>(lo),
          hi > options.max_uses ? UseBounds::kUnlimited : static_cast<Index>(hi)};
}

}  // namespace

Instance generate_bounded(const BoundedOptions& options) {
  generate::require_ranges(options);
  generate::require_moderate(options.dimensions, options.size, static_cast<double>(options.arcs));
  Draw draw(options.seed);
  const std::vector<Index> sizes(static_cast<std::size_t>(options.dimensions), options.size);
  ProblemBuilder builder(sizes);
  std::vector<Index> alone(sizes.size(), 0);
  for (int k = 0; k < options.dimensions; ++k) {
    Index& index = alone[static_cast<std::size_t>(k)];
    for (index = 1; index <= options.size; ++index) {
      builder.add_arc(alone, static_cast<double>(draw.integer(0, options.max_cost)));
      if (draw.uniform() < options.bounds_share)
        builder.set_use_bounds(k, index, draw_bounds(draw, options));
    }
    index = 0;
  }
  for (std::size_t a = 0; a < options.arcs; ++a) {
    const std::vector<Index> tuple = draw_tuple(draw, options);
    builder.add_arc(tuple, static_cast<double>(draw.integer(-options.max_cost, options.max_cost)));
  }
  return {std::move(builder).build(),
          {generate::Parameters("bounded", options).command()},
          std::nullopt};
}

}  // namespace nda
