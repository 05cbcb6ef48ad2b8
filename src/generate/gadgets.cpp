#include <algorithm>
#include <set>
#include <string>

#include "generate/parameters.hpp"
#include "generate/portable.hpp"
#include "nda/generate.hpp"

// A gadget is a random problem of a few arcs, kept only if its LP has a gap.  No LP is solved:
// enumeration with every arc taken 0 or 1 times finds the optimum, enumeration with 0, 1 or 2 times
// and every index available twice finds twice the best half-integral value, which is a point of the
// LP.  If that is less, so is the LP value.  (Three arcs that meet pairwise in three different
// indices are the smallest such gadget.)

namespace nda {
namespace {

using generate::Draw;

using Tuple = std::vector<Index>;

struct Gadget {
  std::vector<Tuple> tuples;
  std::vector<int> costs;  // negative
  int optimum = 0;
  int twice_half_integral = 0;  // twice the best half-integral value
};

// The least cost of taking arcs up to `capacity` times and indices no more than `capacity` times.
class Packing {
 public:
  Packing(const Gadget& gadget, Index size, int capacity)
      : gadget_(gadget), capacity_(capacity), left_(gadget.costs.size() + 1, 0) {
    used_.assign(gadget.tuples[0].size(), std::vector<int>(size + std::size_t{1}, 0));
    for (std::size_t a = gadget.costs.size(); a-- > 0;) {
      left_[a] = left_[a + 1] + capacity * gadget.costs[a];
    }
  }

  int solve() {
    search(0, 0);
    return best_;
  }

 private:
  bool fits(const Tuple& tuple) const {
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      if (tuple[k] != 0 && used_[k][tuple[k]] >= capacity_) return false;
    }
    return true;
  }

  void use(const Tuple& tuple, int times) {
    for (std::size_t k = 0; k < tuple.size(); ++k) used_[k][tuple[k]] += times;
  }

  void search(std::size_t a, int cost) {
    best_ = std::min(best_, cost);
    if (a == gadget_.costs.size() || cost + left_[a] >= best_) return;
    const Tuple& tuple = gadget_.tuples[a];
    int times = 0;
    while (times < capacity_ && fits(tuple)) {
      use(tuple, 1);
      ++times;
    }
    for (; times > 0; --times) {
      search(a + 1, cost + times * gadget_.costs[a]);
      use(tuple, -1);
    }
    search(a + 1, cost);
  }

  const Gadget& gadget_;
  int capacity_;
  std::vector<int> left_;  // cost of taking every arc from a on
  std::vector<std::vector<int>> used_;
  int best_ = 0;
};

Tuple draw_tuple(Draw& draw, const GadgetsOptions& options) {
  Tuple tuple(static_cast<std::size_t>(options.dimensions), 0);
  int real = 0;
  while (real < 2) {
    real = 0;
    for (Index& index : tuple) {
      index = draw.below(3) == 0 ? 0 : static_cast<Index>(draw.integer(1, options.size));
      real += index != 0;
    }
  }
  return tuple;
}

Gadget draw_candidate(Draw& draw, const GadgetsOptions& options) {
  std::set<Tuple> tuples;
  for (int a = 0; a < options.arcs_per_gadget; ++a) tuples.insert(draw_tuple(draw, options));
  Gadget gadget;
  gadget.tuples.assign(tuples.begin(), tuples.end());
  for (std::size_t a = 0; a < gadget.tuples.size(); ++a) {
    gadget.costs.push_back(static_cast<int>(draw.integer(-options.max_cost, -1)));
  }
  gadget.optimum = Packing(gadget, options.size, 1).solve();
  gadget.twice_half_integral = Packing(gadget, options.size, 2).solve();
  return gadget;
}

Gadget draw_gadget(Draw& draw, const GadgetsOptions& options) {
  constexpr int kMaxTries = 100000;
  for (int i = 0; i < kMaxTries; ++i) {
    Gadget gadget = draw_candidate(draw, options);
    if (gadget.twice_half_integral < 2 * gadget.optimum) return gadget;
  }
  throw InputError("no gadget with a gap in " + std::to_string(kMaxTries) +
                   " tries: take fewer dimensions or larger sizes");
}

void validate(const GadgetsOptions& options) {
  generate::require_ranges(options);
  const double gadgets = options.gadgets;
  generate::require_moderate(
      options.dimensions, gadgets * options.size, gadgets * options.arcs_per_gadget);
}

// labels[k][g * size + i - 1]: the final index of index i of gadget g.
std::vector<std::vector<Index>> draw_labels(Draw& draw, const GadgetsOptions& options) {
  std::vector<std::vector<Index>> labels(static_cast<std::size_t>(options.dimensions));
  for (std::vector<Index>& of_dimension : labels) {
    of_dimension.resize(static_cast<std::size_t>(options.gadgets) * options.size);
    for (std::size_t i = 0; i < of_dimension.size(); ++i)
      of_dimension[i] = static_cast<Index>(i) + 1;
    draw.shuffle(of_dimension);
  }
  return labels;
}

std::vector<std::string> comments(const GadgetsOptions& options,
                                  std::int64_t optimum,
                                  std::int64_t twice_half) {
  const generate::Micro half = twice_half * (generate::kMicrosPerUnit / 2);
  return {generate::Parameters("gadgets", options).command(),
          "optimum " + std::to_string(optimum) + " (enumerated)",
          "LP value at most " + generate::decimal(half) + " (half-integral)"};
}

}  // namespace

Instance generate_gadgets(const GadgetsOptions& options) {
  validate(options);
  Draw draw(options.seed);
  const auto labels = draw_labels(draw, options);
  ProblemBuilder builder(std::vector<Index>(labels.size(), static_cast<Index>(labels[0].size())));
  std::int64_t optimum = 0, twice_half = 0;
  for (std::size_t g = 0; g < static_cast<std::size_t>(options.gadgets); ++g) {
    Gadget gadget = draw_gadget(draw, options);
    optimum += gadget.optimum;
    twice_half += gadget.twice_half_integral;
    for (std::size_t a = 0; a < gadget.costs.size(); ++a) {
      Tuple& tuple = gadget.tuples[a];
      for (std::size_t k = 0; k < tuple.size(); ++k) {
        if (tuple[k] != 0) tuple[k] = labels[k][g * options.size + tuple[k] - 1];
      }
      builder.add_arc(tuple, gadget.costs[a]);
    }
  }
  return {std::move(builder).build(),
          comments(options, optimum, twice_half),
          static_cast<double>(optimum)};
}

}  // namespace nda
