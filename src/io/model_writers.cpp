#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/writers.hpp"
#include "nda/types.hpp"

// The assignment problem as an integer program that any solver reads, for cross-checks.  One binary
// column per arc (x_1_0_2 is the arc (1, 0, 2)) and per singleton that is not forbidden (x_0_3_0),
// one row per index: c_2_3 says that index 3 of dimension 2 is used exactly once.  Names must stay
// within the 100 characters of COIN's LP reader; where tuples are too long for that, columns are
// numbered.
//
// The third word of an MPS file's first line, FREE, keeps COIN's reader from guessing the format
// line by line, by the columns that words happen to start in.
//
// Where an index has bounds lo..hi of its own, its row is a range and its singleton's column an
// integer from 0 to hi.  Not every reader of LP files knows ranges, so they become two rows there,
// c_2_3 and d_2_3.  An integer column of an MPS file has no default bounds that all readers share,
// so each gets its own.
//
// An index that nothing may use makes the problem infeasible, but an LP file cannot hold an empty
// row: a column `never`, fixed at 0, stands in it.

namespace nda::io {
namespace {

constexpr std::size_t kLongestName = 100;
constexpr std::string_view kNever = "never";

class Model {
 public:
  explicit Model(const Problem& problem) : problem_(problem) {
    std::size_t length = 1;
    for (const Index size : problem.sizes()) length += 1 + std::to_string(size).size();
    by_tuple_ = length <= kLongestName;
    std::size_t next = problem.num_arcs() + 1;
    for (const Index size : problem.sizes()) {
      first_singleton_.push_back(next);
      next += size;
    }
  }

  const Problem& problem() const { return problem_; }
  int num_dimensions() const { return problem_.num_dimensions(); }
  Index size(int k) const { return problem_.size(k); }
  UseBounds bounds(int k, Index i) const { return problem_.use_bounds(k, i); }
  // Whether x of the singleton is 0 or 1.
  bool is_binary(int k, Index i) const { return bounds(k, i).hi <= 1; }
  bool has_singleton(int k, Index i) const { return problem_.singleton_costs(k)[i] < kInfinity; }

  void write_arc(TextWriter& out, std::size_t a) const {
    out << 'x';
    if (!by_tuple_) {
      out << std::uint64_t{a + 1};
      return;
    }
    for (int k = 0; k < num_dimensions(); ++k) out << '_' << std::uint64_t{problem_.indices(k)[a]};
  }

  void write_singleton(TextWriter& out, int dimension, Index index) const {
    out << 'x';
    if (!by_tuple_) {
      out << std::uint64_t{first_singleton_[static_cast<std::size_t>(dimension)] + index - 1};
      return;
    }
    for (int k = 0; k < num_dimensions(); ++k) {
      out << '_' << std::uint64_t{k == dimension ? index : 0};
    }
  }

  static void write_row(TextWriter& out, int k, Index i, char letter = 'c') {
    out << letter << '_' << static_cast<std::uint64_t>(k + 1) << '_' << std::uint64_t{i};
  }

  // Calls visit(write_name, cost) for every column, arcs first.
  template <typename Visit>
  void for_each_column(Visit visit) const {
    for (std::size_t a = 0; a < problem_.num_arcs(); ++a) {
      visit([this, a](TextWriter& out) { write_arc(out, a); }, problem_.costs()[a]);
    }
    for_each_singleton([&](int k, Index i, double cost) {
      visit([this, k, i](TextWriter& out) { write_singleton(out, k, i); }, cost);
    });
  }

  template <typename Visit>
  void for_each_singleton(Visit visit) const {
    for (int k = 0; k < num_dimensions(); ++k) {
      for (Index i = 1; i <= size(k); ++i) {
        if (has_singleton(k, i)) visit(k, i, problem_.singleton_costs(k)[i]);
      }
    }
  }

 private:
  const Problem& problem_;
  bool by_tuple_ = true;
  std::vector<std::size_t> first_singleton_;
};

// The arcs of one dimension by index: those of index i are arcs[start[i]] .. arcs[start[i + 1] -
// 1].
struct ArcsByIndex {
  ArcsByIndex(const Problem& problem, int k)
      : start(problem.size(k) + std::size_t{2}, 0), arcs(problem.num_arcs()) {
    const std::span<const Index> indices = problem.indices(k);
    for (const Index i : indices) ++start[i + std::size_t{1}];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::size_t a = 0; a < indices.size(); ++a) {
      arcs[next[indices[a]]++] = static_cast<std::uint32_t>(a);
    }
  }

  std::span<const std::uint32_t> of(Index i) const {
    return std::span(arcs).subspan(start[i], start[i + std::size_t{1}] - start[i]);
  }

  std::vector<std::uint32_t> start;
  std::vector<std::uint32_t> arcs;
};

// One line per row would be too long for some readers: every term gets a line.
void write_lp_objective(const Model& model, TextWriter& out) {
  out << "minimize\n obj:";
  model.for_each_column([&](auto write_name, double cost) {
    out << (std::signbit(cost) ? "\n - " : "\n + ") << std::abs(cost) << ' ';
    write_name(out);
  });
  out << "\n + 0 " << kNever << '\n';
}

struct RowEnd {
  const char* relation;
  Index value;
};

void write_lp_row(const Model& model,
                  TextWriter& out,
                  int k,
                  Index i,
                  std::span<const std::uint32_t> arcs,
                  char letter,
                  RowEnd end) {
  out << ' ';
  Model::write_row(out, k, i, letter);
  out << ':';
  for (const std::uint32_t a : arcs) {
    out << "\n + ";
    model.write_arc(out, a);
  }
  if (model.has_singleton(k, i)) {
    out << "\n + ";
    model.write_singleton(out, k, i);
  } else if (arcs.empty()) {
    out << ' ' << kNever;
  }
  out << ' ' << end.relation << ' ' << std::uint64_t{end.value} << '\n';
}

void write_lp_rows(
    const Model& model, TextWriter& out, int k, Index i, std::span<const std::uint32_t> arcs) {
  const auto [lo, hi] = model.bounds(k, i);
  if (lo == hi) return write_lp_row(model, out, k, i, arcs, 'c', {"=", lo});
  write_lp_row(model, out, k, i, arcs, 'c', {">=", lo});
  if (hi != UseBounds::kUnlimited) write_lp_row(model, out, k, i, arcs, 'd', {"<=", hi});
}

// Columns of arcs and of singletons that are chosen once at most; the others have bounds.
void write_lp_columns(const Model& model, TextWriter& out) {
  model.for_each_singleton([&](int k, Index i, double) {
    const Index hi = model.bounds(k, i).hi;
    if (model.is_binary(k, i) || hi == UseBounds::kUnlimited) return;
    out << " 0 <= ";
    model.write_singleton(out, k, i);
    out << " <= " << std::uint64_t{hi} << '\n';
  });
  out << "binaries\n";
  for (std::size_t a = 0; a < model.problem().num_arcs(); ++a) {
    out << ' ';
    model.write_arc(out, a);
    out << '\n';
  }
  std::string_view heading;
  const auto write_singletons = [&](bool binary) {
    model.for_each_singleton([&](int k, Index i, double) {
      if (model.is_binary(k, i) != binary) return;
      out << std::exchange(heading, {}) << ' ';
      model.write_singleton(out, k, i);
      out << '\n';
    });
  };
  write_singletons(true);
  heading = "generals\n";
  write_singletons(false);
}

}  // namespace

void write_lp(const Problem& problem, TextWriter& out) {
  const Model model(problem);
  write_lp_objective(model, out);
  out << "subject to\n";
  for (int k = 0; k < model.num_dimensions(); ++k) {
    const ArcsByIndex by_index(problem, k);
    for (Index i = 1; i <= model.size(k); ++i) write_lp_rows(model, out, k, i, by_index.of(i));
  }
  out << "bounds\n " << kNever << " = 0\n";
  write_lp_columns(model, out);
  out << "end\n";
  out.finish();
}

namespace {

void write_mps_entry(const Model& model, TextWriter& out, std::size_t a, int k) {
  out << ' ';
  model.write_arc(out, a);
  out << ' ';
  Model::write_row(out, k, model.problem().indices(k)[a]);
  out << " 1\n";
}

void write_mps_columns(const Model& model, TextWriter& out) {
  const Problem& problem = model.problem();
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    out << ' ';
    model.write_arc(out, a);
    out << " cost " << problem.costs()[a] << '\n';
    for (int k = 0; k < model.num_dimensions(); ++k) {
      if (problem.indices(k)[a] != 0) write_mps_entry(model, out, a, k);
    }
  }
  model.for_each_singleton([&](int k, Index i, double cost) {
    out << ' ';
    model.write_singleton(out, k, i);
    out << " cost " << cost << ' ';
    Model::write_row(out, k, i);
    out << " 1\n";
  });
}

// Calls write() for every row of the model.
template <typename Write>
void for_each_row(const Model& model, Write write) {
  for (int k = 0; k < model.num_dimensions(); ++k) {
    for (Index i = 1; i <= model.size(k); ++i) write(k, i);
  }
}

void write_mps_rhs(const Model& model, TextWriter& out) {
  out << "RHS\n";
  for_each_row(model, [&](int k, Index i) {
    out << " rhs ";
    Model::write_row(out, k, i);
    out << ' ' << std::uint64_t{model.bounds(k, i).lo} << '\n';
  });
  if (!model.problem().is_many_to_one()) return;
  out << "RANGES\n";
  for_each_row(model, [&](int k, Index i) {
    const auto [lo, hi] = model.bounds(k, i);
    if (lo == hi || hi == UseBounds::kUnlimited) return;
    out << " rng ";
    Model::write_row(out, k, i);
    out << ' ' << std::uint64_t{hi - lo} << '\n';
  });
}

void write_mps_bounds(const Model& model, TextWriter& out) {
  out << "BOUNDS\n";
  for (std::size_t a = 0; a < model.problem().num_arcs(); ++a) {
    out << " BV bnd ";
    model.write_arc(out, a);
    out << '\n';
  }
  model.for_each_singleton([&](int k, Index i, double) {
    const Index hi = model.bounds(k, i).hi;
    const bool is_limited = hi != UseBounds::kUnlimited;
    out << (model.is_binary(k, i) ? " BV bnd " : is_limited ? " UP bnd " : " PL bnd ");
    model.write_singleton(out, k, i);
    if (!model.is_binary(k, i) && is_limited) out << ' ' << std::uint64_t{hi};
    out << '\n';
  });
}

}  // namespace

void write_mps(const Problem& problem, TextWriter& out) {
  const Model model(problem);
  out << "NAME nda FREE\nROWS\n N cost\n";
  for_each_row(model, [&](int k, Index i) {
    const auto [lo, hi] = model.bounds(k, i);
    out << (lo == hi ? " E " : " G ");
    Model::write_row(out, k, i);
    out << '\n';
  });
  out << "COLUMNS\n M1 'MARKER' 'INTORG'\n";
  write_mps_columns(model, out);
  out << " M2 'MARKER' 'INTEND'\n";
  write_mps_rhs(model, out);
  write_mps_bounds(model, out);
  out << "ENDATA\n";
  out.finish();
}

}  // namespace nda::io
