#include "cutting/dive.hpp"

#include <algorithm>
#include <utility>
#include <vector>

// Diving is what general solvers find their packings by.  What differs: the program is not priced
// again on the way (the arcs that the relaxed point needed are enough to make good packings), and
// whatever has a value of kTake or more is taken at once.

namespace nda::cutting {
namespace {

using core::ArcId;

constexpr double kTake = 0.9;
constexpr double kZero = 1e-6;
constexpr double kNoise = 0.2;
constexpr int kMostPivots = 100000;  // of one solve

class Dive {
 public:
  Dive(const core::Component& component, Master& master, core::Random& random)
      : component_(component), master_(master), random_(random), taken_(component.num_arcs(), 0) {}

  core::Packing run(const core::Deadline& deadline) {
    for (Order order = candidates(); !order.empty(); order = candidates()) {
      take(order);
      master_.trial(kMostPivots, deadline);
      if (deadline.reached()) {
        arcs_.clear();
        break;
      }
    }
    master_.allow(forbidden_);
    master_.solve(kInfinity, deadline);
    return core::make_packing(component_, std::move(arcs_));
  }

 private:
  using Order = std::vector<std::pair<double, ArcId>>;  // minus the disturbed values

  Order candidates() {
    Order order;
    for (std::size_t k = 0; k < master_.arcs().size(); ++k) {
      const double x = master_.values()[k];
      const ArcId a = master_.arcs()[k];
      if (x > kZero && taken_[a] == 0 && !master_.forbidden(a))
        order.emplace_back(-x * random_.uniform(1, 1 + kNoise), a);
    }
    std::sort(order.begin(), order.end());
    return order;
  }

  void take(const Order& order) {
    for (const auto& [value, a] : order) {
      if (&value != &order.front().first && -value < kTake) break;
      if (master_.forbidden(a)) continue;
      taken_[a] = 1;
      arcs_.push_back(a);
      forbid_what_excludes(a);
    }
  }

  void forbid_what_excludes(ArcId a) {
    std::vector<ArcId> others;
    core::for_each_slot(component_, a, [&](std::uint32_t slot) {
      for (const ArcId b : master_.index()[slot]) {
        if (b != a && !master_.forbidden(b)) others.push_back(b);
      }
    });
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    master_.forbid(others);
    forbidden_.insert(forbidden_.end(), others.begin(), others.end());
  }

  const core::Component& component_;
  Master& master_;
  core::Random& random_;
  std::vector<char> taken_;  // [arc]
  std::vector<ArcId> arcs_;
  std::vector<ArcId> forbidden_;
};

}  // namespace

core::Packing dive(const core::Component& component,
                   Master& master,
                   core::Random& random,
                   const core::Deadline& deadline) {
  return Dive(component, master, random).run(deadline);
}

}  // namespace nda::cutting
