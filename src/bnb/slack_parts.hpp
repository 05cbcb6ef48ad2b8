#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bnb/slack_search.hpp"

namespace nda::bnb {

/// An arc that fits, with what using it still costs.
struct OpenArc {
  std::uint32_t arc;
  double reduced;
};

/// A row with capacity left, and what a unit of it costs when it stays unused.
struct OpenRow {
  std::uint32_t row;
  std::uint32_t left;
  double price;
};

inline constexpr std::uint32_t kNoPart = ~std::uint32_t{0};

/// Open arcs and rows divided into parts that share nothing, the smallest first.
class Parts {
 public:
  std::size_t size() const { return num_; }
  /// The arcs and rows of a part.
  void copy(std::size_t part,
            const std::vector<OpenArc>& arcs,
            const std::vector<OpenRow>& rows,
            std::vector<OpenArc>& part_arcs,
            std::vector<OpenRow>& part_rows) const;

 private:
  friend class PartFinder;

  std::size_t num_ = 0;
  std::vector<std::uint32_t> arc_part_;  // [position in the list]
  std::vector<std::uint32_t> row_part_;
};

/// Finds the parts of a node by union and find over rows.  Cost: about that of looking at all arcs
/// twice.
class PartFinder {
 public:
  explicit PartFinder(const SlackProblem& problem)
      : problem_(problem), parent_(problem.num_rows(), 0), label_(problem.num_rows(), 0) {}

  /// Returns whether there is more than one part.  Arcs that touch no open row are in none: using
  /// them gains nothing.
  bool split(const std::vector<OpenArc>& arcs, const std::vector<OpenRow>& rows, Parts& parts);

 private:
  void join(const std::vector<OpenArc>& arcs, const std::vector<OpenRow>& rows);
  void label(const std::vector<OpenRow>& rows);
  std::uint32_t part_of(std::uint32_t arc);
  void rank_by_size();

  const SlackProblem& problem_;
  std::vector<std::uint32_t> parent_;  // [row]: kNoPart = connects nothing
  std::vector<std::uint32_t> label_;   // [row]: of a root: its part
  std::vector<std::uint32_t> size_;    // [part]: arcs
  std::vector<std::uint32_t> rank_;    // [part]
};

}  // namespace nda::bnb
