#include <algorithm>
#include <string>

#include "generate/parameters.hpp"
#include "generate/portable.hpp"
#include "nda/generate.hpp"

// Linear programming duality turned round.  Multipliers come first; a feasible solution is planted
// whose arcs cost exactly the sum of their multipliers and whose uncovered indices pay exactly
// theirs; everything else costs that sum plus a slack >= 0.  Then the multipliers are dual
// feasible, the planted solution meets them, and both have the value sum u.  All sums are of
// integers (millionths), so the optimum is exact. The slack is small against the spread of the
// multipliers: the cheapest arcs are not the planted ones.

namespace nda {
namespace {

using generate::Draw;
using generate::Micro;

// Cells of the planted solution: row r holds at most one index of each dimension, 0 = none.
using Rows = std::vector<std::vector<Index>>;

int num_real(const std::vector<Index>& tuple) {
  return static_cast<int>(
      std::count_if(tuple.begin(), tuple.end(), [](Index i) { return i != 0; }));
}

class Planting {
 public:
  explicit Planting(const PlantedOptions& options)
      : options_(options),
        num_dimensions_(static_cast<std::size_t>(options.dimensions)),
        draw_(options.seed),
        builder_(std::vector<Index>(num_dimensions_, options.size)) {}

  Instance run() {
    draw_multipliers();
    const Rows rows = draw_rows();
    builder_.reserve(rows.size() + options_.arcs);
    price_singletons(rows);
    plant(rows);
    for (std::size_t a = 0; a < options_.arcs; ++a) {
      const std::vector<Index> tuple = draw_tuple(centre_of(a));
      builder_.add_arc(tuple, generate::from_micro(sum_of_multipliers(tuple) + slack()));
    }
    const Micro optimum = total();
    return {std::move(builder_).build(), comments(optimum), generate::from_micro(optimum)};
  }

 private:
  void draw_multipliers() {
    const Micro size = generate::to_micro(options_.max_multiplier);
    const Micro high = options_.singletons == PlantedSingletons::kFree ? 0 : size;
    multipliers_.assign(num_dimensions_, {});
    for (std::vector<Micro>& u : multipliers_) {
      u.assign(options_.size + std::size_t{1}, 0);
      for (Index i = 1; i <= options_.size; ++i) u[i] = draw_.integer(-size, high);
    }
  }

  // Each dimension puts its indices on as many rows, chosen at random, in order or (spread 0) in
  // disorder.
  Rows draw_rows() {
    const double size = options_.size;
    const std::size_t num_rows = static_cast<std::size_t>(size / (1 - options_.miss_rate));
    Rows rows(num_rows, std::vector<Index>(num_dimensions_, 0));
    for (std::size_t k = 0; k < num_dimensions_; ++k) {
      std::vector<Index> labels(options_.size);
      for (Index i = 0; i < options_.size; ++i) labels[i] = i + 1;
      if (options_.spread == 0) draw_.shuffle(labels);
      std::size_t next = 0;
      for (std::size_t r = 0; r < num_rows; ++r) {
        if (draw_.below(num_rows - r) < labels.size() - next) rows[r][k] = labels[next++];
      }
    }
    return rows;
  }

  Micro slack() { return draw_.integer(0, generate::to_micro(options_.max_slack)); }

  // Index i of dimension k alone in its row is left to its singleton, which must then cost u[k][i].
  void price_singletons(const Rows& rows) {
    if (options_.singletons == PlantedSingletons::kFree) {
      for (const std::vector<Index>& row : rows) {
        if (num_real(row) != 1) continue;
        for (std::size_t k = 0; k < num_dimensions_; ++k) multipliers_[k][row[k]] = 0;
      }
      return;
    }
    std::vector<std::vector<bool>> alone(num_dimensions_, std::vector<bool>(options_.size + 1));
    for (const std::vector<Index>& row : rows) {
      for (std::size_t k = 0; k < num_dimensions_; ++k) alone[k][row[k]] = num_real(row) == 1;
    }
    std::vector<Index> tuple(num_dimensions_, 0);
    for (std::size_t k = 0; k < num_dimensions_; ++k) {
      for (Index i = 1; i <= options_.size; ++i) {
        tuple[k] = i;
        const Micro price = multipliers_[k][i] + (alone[k][i] ? 0 : slack());
        builder_.add_arc(tuple,
                         options_.singletons == PlantedSingletons::kPriced
                             ? generate::from_micro(price)
                             : kInfinity);
      }
      tuple[k] = 0;
    }
  }

  void plant(const Rows& rows) {
    for (const std::vector<Index>& row : rows) {
      if (num_real(row) >= 2) builder_.add_arc(row, generate::from_micro(sum_of_multipliers(row)));
    }
  }

  // Centres run evenly through the indices, so the arcs come nearly sorted and build fast.
  std::int64_t centre_of(std::size_t a) const {
    return 1 + static_cast<std::int64_t>(a * options_.size / options_.arcs);
  }

  std::vector<Index> draw_tuple(std::int64_t centre) {
    std::vector<Index> tuple(num_dimensions_, 0);
    do {
      for (Index& index : tuple) {
        index = draw_.uniform() < options_.miss_rate ? 0 : draw_index(centre);
      }
    } while (num_real(tuple) < 2);
    return tuple;
  }

  Index draw_index(std::int64_t centre) {
    if (options_.spread == 0) return static_cast<Index>(draw_.integer(1, options_.size));
    const std::int64_t half = options_.spread / 2;
    const std::int64_t index = centre + draw_.integer(-half, options_.spread - half);
    return static_cast<Index>(std::clamp<std::int64_t>(index, 1, options_.size));
  }

  Micro sum_of_multipliers(const std::vector<Index>& tuple) const {
    Micro sum = 0;
    for (std::size_t k = 0; k < tuple.size(); ++k) sum += multipliers_[k][tuple[k]];
    return sum;
  }

  Micro total() const {
    Micro sum = 0;
    for (const std::vector<Micro>& u : multipliers_) {
      for (const Micro value : u) sum += value;
    }
    return sum;
  }

  std::vector<std::string> comments(Micro optimum) const {
    static const char* const kNames[] = {"free", "priced", "forbidden"};
    generate::Parameters parameters("planted", options_);
    parameters.add("singletons", kNames[static_cast<int>(options_.singletons)]);
    return {parameters.command(),
            "optimum " + generate::decimal(optimum) + " (planted; also the LP value)"};
  }

  const PlantedOptions& options_;
  std::size_t num_dimensions_;
  Draw draw_;
  ProblemBuilder builder_;
  std::vector<std::vector<Micro>> multipliers_;  // [k][i], 0 for the dummy
};

void validate(const PlantedOptions& options) {
  generate::require_ranges(options);
  const double num_rows = options.size / (1 - options.miss_rate);
  generate::require_moderate(
      options.dimensions, options.size, static_cast<double>(options.arcs) + num_rows);
  generate::require(options.singletons != PlantedSingletons::kForbidden || options.miss_rate == 0,
                    "miss_rate",
                    options.miss_rate,
                    "must be 0 when singletons are forbidden");
}

}  // namespace

Instance generate_planted(const PlantedOptions& options) {
  validate(options);
  return Planting(options).run();
}

}  // namespace nda
