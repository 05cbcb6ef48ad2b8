#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "generate/parameters.hpp"
#include "generate/portable.hpp"
#include "generate/scenario.hpp"
#include "nda/generate.hpp"

// Scans of targets whose places are predicted.  The sensor sees two that are close to each other as
// one detection halfway, and some alone as two detections.  Arcs are a target with a detection or
// none of each scan, inside the gate.  What a second use of a detection or a target costs is
// charged to every use and to none (docs/many_to_one.md), so every solution costs a constant too
// much, which the file states.

namespace nda {
namespace {

using generate::Draw;
using generate::Micro;
using generate::natural_log;
using generate::Point;
using generate::Scan;

constexpr double kMostHypotheses = 1e7;

Point draw_position(Draw& draw, const MergedOptions& options) {
  const double x = options.side * draw.uniform();
  return {x, options.side * draw.uniform()};
}

Point deviate(Draw& draw, Point from, double deviation) {
  const double x = from.x + deviation * draw.gaussian();
  return {x, from.y + deviation * draw.gaussian()};
}

double squared_distance(Point a, Point b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

// Each target is seen where it is, together with the first one before it that is not resolved from
// it and still alone.
Scan resolved(const std::vector<Point>& seen, double resolution, std::vector<bool>& is_pair) {
  Scan scan;
  for (const Point& point : seen) {
    std::size_t d = 0;
    while (d < scan.size() &&
           (is_pair[d] || squared_distance(scan[d], point) > resolution * resolution))
      ++d;
    if (d == scan.size()) {
      scan.push_back(point);
      is_pair.push_back(false);
    } else {
      scan[d] = {(scan[d].x + point.x) / 2, (scan[d].y + point.y) / 2};
      is_pair[d] = true;
    }
  }
  return scan;
}

Scan draw_scan(Draw& draw, const MergedOptions& options, const std::vector<Point>& targets) {
  std::vector<Point> seen;
  for (const Point& target : targets) {
    if (draw.uniform() >= options.detection_probability) continue;
    seen.push_back(deviate(draw, target, options.noise));
  }
  std::vector<bool> is_pair;
  Scan scan = resolved(seen, options.resolution, is_pair);
  for (std::size_t d = 0; d < is_pair.size(); ++d) {
    if (is_pair[d] || draw.uniform() >= options.split_probability) continue;
    Point half;
    draw.disc(options.resolution / 2, half.x, half.y);
    scan.push_back({scan[d].x + half.x, scan[d].y + half.y});
    scan[d] = {scan[d].x - half.x, scan[d].y - half.y};
  }
  const int clutter = draw.poisson(options.clutter);
  for (int c = 0; c < clutter; ++c) scan.push_back(draw_position(draw, options));
  std::sort(scan.begin(), scan.end(), [](const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  return scan;
}

// What a target may be in one scan: index of a detection, or 0, and its cost.
using Choices = std::vector<std::pair<Index, Micro>>;

class Hypotheses {
 public:
  Hypotheses(const MergedOptions& options, const std::vector<Scan>& scans)
      : scans_(scans),
        variance_(options.noise * options.noise + options.resolution * options.resolution / 4),
        gate_(-2 * natural_log(1 - options.gate_probability) * variance_),
        merge_(generate::to_micro(options.merge_penalty)),
        split_(generate::to_micro(options.split_penalty)),
        miss_(generate::to_micro(-natural_log(1 - options.detection_probability))) {
    const double clutter_density = options.clutter / (options.side * options.side);
    fixed_ = natural_log(2 * generate::kPi * variance_) -
             natural_log(options.detection_probability / clutter_density);
  }

  void add(Index target, Point place, ProblemBuilder& builder) {
    choices_.clear();
    double count = 1;
    for (const Scan& scan : scans_) {
      choices_.push_back(choices(place, scan));
      count *= static_cast<double>(choices_.back().size());
    }
    num_ += count;
    generate::require_within("the number of hypotheses", num_, 0, kMostHypotheses);
    tuple_.assign(scans_.size() + 1, 0);
    tuple_[0] = target;
    extend(0, split_, builder);
  }

  Micro merge_penalty() const { return merge_; }
  Micro split_penalty() const { return split_; }

 private:
  Choices choices(Point place, const Scan& scan) const {
    Choices choices = {{0, miss_}};
    for (std::size_t d = 0; d < scan.size(); ++d) {
      const double squared = squared_distance(place, scan[d]);
      if (squared > gate_) continue;
      const double cost = fixed_ + squared / (2 * variance_);
      choices.emplace_back(static_cast<Index>(d + 1), generate::to_micro(cost) + merge_);
    }
    return choices;
  }

  // The tuple without any detection is the singleton of the target.
  void extend(std::size_t scan, Micro cost, ProblemBuilder& builder) {
    if (scan == choices_.size()) return builder.add_arc(tuple_, generate::from_micro(cost));
    for (const auto& [index, more] : choices_[scan]) {
      tuple_[scan + 1] = index;
      extend(scan + 1, cost + more, builder);
    }
  }

  const std::vector<Scan>& scans_;
  const double variance_;
  const double gate_;
  const Micro merge_;
  const Micro split_;
  const Micro miss_;
  double fixed_;
  std::vector<Choices> choices_;  // by scan
  std::vector<Index> tuple_;
  double num_ = 0;
};

}  // namespace

Instance generate_merged(const MergedOptions& options) {
  generate::require_ranges(options);
  Draw draw(options.seed);
  std::vector<Point> targets;
  for (int t = 0; t < options.targets; ++t) targets.push_back(draw_position(draw, options));
  std::vector<Scan> scans;
  for (int s = 0; s < options.scans; ++s) scans.push_back(draw_scan(draw, options, targets));
  std::vector<Index> sizes = {static_cast<Index>(options.targets)};
  for (const Scan& scan : scans) sizes.push_back(static_cast<Index>(scan.size()));
  ProblemBuilder builder(sizes);
  Hypotheses hypotheses(options, scans);
  for (std::size_t t = 0; t < targets.size(); ++t)
    hypotheses.add(static_cast<Index>(t + 1), targets[t], builder);
  Micro constant = 0;
  for (int k = 0; k <= options.scans; ++k) {
    std::vector<Index> tuple(sizes.size(), 0);
    for (Index i = 1; i <= sizes[static_cast<std::size_t>(k)]; ++i) {
      builder.set_use_bounds(k, i, {1, 2});
      constant += k == 0 ? hypotheses.split_penalty() : hypotheses.merge_penalty();
      tuple[static_cast<std::size_t>(k)] = i;
      if (k > 0) builder.add_arc(tuple, generate::from_micro(hypotheses.merge_penalty()));
    }
  }
  return {std::move(builder).build(),
          {generate::Parameters("merged", options).command(),
           "the penalties add " + generate::decimal(constant) + " to the cost of every solution"},
          std::nullopt};
}

}  // namespace nda
