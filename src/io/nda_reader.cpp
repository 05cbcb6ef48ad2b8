#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/readers.hpp"
#include "nda/types.hpp"

namespace nda::io {
namespace {

class NdaReader {
 public:
  NdaReader(Scanner& scanner, const ReadOptions& options) : scanner_(scanner), options_(options) {}

  Problem read() {
    while (scanner_.next_line()) {
      if (scanner_.peek() == 'c') {
        scanner_.skip_line();
      } else if (builder_ && scanner_.at_word('a')) {
        read_arc();
      } else {
        read_rare_line();
      }
    }
    if (!builder_) scanner_.fail("expected a line 'p nda ...', found the end of the file");
    if (num_arcs_ < announced_) {
      scanner_.fail("the file ends after " + std::to_string(num_arcs_) + " arc lines, " +
                    std::to_string(announced_) + " announced");
    }
    return std::move(*builder_).build();
  }

 private:
  void read_rare_line() {
    const bool header = scanner_.at_word('p');
    if (!header && !scanner_.at_word('a') && !scanner_.at_word('b')) {
      scanner_.fail("expected a line that begins with a, b, c or p, found " + scanner_.found());
    }
    if (header == builder_.has_value()) {
      scanner_.fail(header ? "second 'p' line" : scanner_.found() + " line before the 'p' line");
    }
    header ? read_header() : read_bounds();
  }

  void read_header() {
    scanner_.advance();
    if (scanner_.word() != "nda") scanner_.fail("expected 'p nda', found " + scanner_.found());
    for (int i = 0; i < 3; ++i) scanner_.advance();
    const int n = read_num_dimensions(scanner_);
    std::vector<Index> sizes;
    for (int k = 1; k <= n; ++k) {
      const std::string what = "the size of dimension " + std::to_string(k);
      sizes.push_back(
          static_cast<Index>(read_whole(scanner_, what, std::numeric_limits<Index>::max())));
    }
    announced_ = read_whole(scanner_, "the number of arcs", std::numeric_limits<Index>::max());
    if (!scanner_.at_line_end()) scanner_.fail("unexpected " + scanner_.found());
    check_sizes(scanner_, options_, sizes);
    const std::size_t least_bytes = 2 * sizes.size() + 3;  // "a 0 0 0" without its newline
    check_backed(scanner_, announced_, least_bytes, "arcs");
    scanner_.finish_line();
    tuple_.resize(sizes.size());
    builder_.emplace(std::move(sizes));
    builder_->reserve(std::min<std::size_t>(announced_, scanner_.likely_bytes() / least_bytes));
  }

  void read_arc() {
    scanner_.advance();
    if (num_arcs_ == announced_) {
      scanner_.fail("more than the " + std::to_string(announced_) + " arc lines announced");
    }
    for (std::size_t k = 0; k < tuple_.size(); ++k) tuple_[k] = read_index(k);
    const double cost = read_cost(scanner_);
    if (!scanner_.at_line_end()) scanner_.fail("unexpected " + scanner_.found());
    add_arc(*builder_, scanner_, tuple_, cost);
    scanner_.finish_line();
    ++num_arcs_;
  }

  Index read_index(std::size_t k) {
    std::uint64_t index = 0;
    if (!scanner_.read_unsigned(index)) {
      scanner_.fail("expected an index of dimension " + std::to_string(k + 1) + ", found " +
                    scanner_.found());
    }
    if (index > builder_->sizes()[k]) {
      scanner_.fail("index " + std::to_string(index) + " of dimension " + std::to_string(k + 1) +
                    " exceeds " + std::to_string(builder_->sizes()[k]));
    }
    return static_cast<Index>(index);
  }

  void read_bounds() {
    scanner_.advance();
    const std::uint64_t k = read_whole(scanner_, "a dimension", tuple_.size());
    if (k == 0) scanner_.fail("dimension 0 does not exist, the first is 1");
    const Index index = read_index(k - 1);
    if (index == 0) scanner_.fail("index 0 of dimension " + std::to_string(k) + " has no bounds");
    UseBounds bounds;
    bounds.lo = read_count("a lower bound");
    const std::string upper_text(scanner_.word());
    bounds.hi = upper_text == "inf" ? skip_inf() : read_count("an upper bound");
    if (bounds.lo > bounds.hi) {
      scanner_.fail("lower bound " + std::to_string(bounds.lo) + " exceeds upper bound " +
                    upper_text);
    }
    scanner_.finish_line();
    builder_->set_use_bounds(static_cast<int>(k) - 1, index, bounds);
  }

  Index read_count(const char* what) {
    return static_cast<Index>(read_whole(scanner_, what, UseBounds::kUnlimited - 1));
  }

  Index skip_inf() {
    for (int i = 0; i < 3; ++i) scanner_.advance();
    return UseBounds::kUnlimited;
  }

  Scanner& scanner_;
  const ReadOptions& options_;
  std::optional<ProblemBuilder> builder_;  // once the header is read
  std::vector<Index> tuple_;
  std::uint64_t announced_ = 0;
  std::uint64_t num_arcs_ = 0;
};

}  // namespace

Problem read_nda(Scanner& scanner, const ReadOptions& options) {
  return NdaReader(scanner, options).read();
}

}  // namespace nda::io
