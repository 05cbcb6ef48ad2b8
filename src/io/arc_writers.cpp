#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/use_bounds.hpp"
#include "io/writers.hpp"
#include "nda/types.hpp"

namespace nda::io {
namespace {

// Calls visit(k, i, cost) for every singleton whose cost is not the default 0.
template <typename Visit>
void for_each_priced_singleton(const Problem& problem, Visit visit) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const std::span<const double> costs = problem.singleton_costs(k);
    for (Index i = 1; i <= problem.size(k); ++i) {
      if (costs[i] != 0) visit(k, i, costs[i]);
    }
  }
}

// One arc per line: lead, indices and cost with `separator` between them.
class ArcLines {
 public:
  ArcLines(const Problem& problem, TextWriter& out, std::string_view lead, char separator)
      : problem_(problem), out_(out), lead_(lead), separator_(separator) {}

  void singleton(int dimension, Index index, double cost) {
    out_ << lead_;
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      out_ << std::uint64_t{k == dimension ? index : 0} << separator_;
    }
    out_ << cost << '\n';
  }

  void arcs() {
    for (std::size_t a = 0; a < problem_.num_arcs(); ++a) {
      out_ << lead_;
      for (int k = 0; k < problem_.num_dimensions(); ++k) {
        out_ << std::uint64_t{problem_.indices(k)[a]} << separator_;
      }
      out_ << problem_.costs()[a] << '\n';
    }
  }

 private:
  const Problem& problem_;
  TextWriter& out_;
  std::string_view lead_;
  char separator_;
};

// Of the indices whose bounds are not 1..1.
void write_bounds(const Problem& problem, TextWriter& out) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const std::span<const UseBounds> bounds = problem.use_bounds(k);
    for (std::size_t i = 1; i < bounds.size(); ++i) {
      if (bounds[i] == UseBounds{}) continue;
      out << "b " << static_cast<std::uint64_t>(k + 1) << ' ' << std::uint64_t{i} << ' '
          << std::uint64_t{bounds[i].lo} << ' ';
      if (bounds[i].hi == UseBounds::kUnlimited)
        out << "inf\n";
      else
        out << std::uint64_t{bounds[i].hi} << '\n';
    }
  }
}

bool occurs(const Problem& problem, int k, Index index) {
  const std::span<const Index> indices = problem.indices(k);
  return problem.singleton_costs(k)[index] != 0 ||
         std::find(indices.begin(), indices.end(), index) != indices.end();
}

}  // namespace

void write_nda(const Problem& problem, TextWriter& out) {
  std::uint64_t num_lines = problem.num_arcs();
  for_each_priced_singleton(problem, [&](int, Index, double) { ++num_lines; });
  out << "p nda " << static_cast<std::uint64_t>(problem.num_dimensions());
  for (const Index size : problem.sizes()) out << ' ' << std::uint64_t{size};
  out << ' ' << num_lines << '\n';
  write_bounds(problem, out);

  ArcLines lines(problem, out, "a ", ' ');
  for_each_priced_singleton(problem,
                            [&](int k, Index i, double cost) { lines.singleton(k, i, cost); });
  lines.arcs();
  out.finish();
}

void write_csv(const Problem& problem, TextWriter& out) {
  core::require_single_uses(problem, "format csv");
  for (int k = 1; k <= problem.num_dimensions(); ++k) {
    out << 'i' << static_cast<std::uint64_t>(k) << ',';
  }
  out << "cost\n";

  ArcLines lines(problem, out, "", ',');
  for_each_priced_singleton(problem,
                            [&](int k, Index i, double cost) { lines.singleton(k, i, cost); });
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const Index last = problem.size(k);
    if (last > 0 && !occurs(problem, k, last)) lines.singleton(k, last, 0);
  }
  lines.arcs();
  out.finish();
}

}  // namespace nda::io
