#include <algorithm>
#include <cctype>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "io/readers.hpp"
#include "nda/types.hpp"

// The sizes of a CSV file are known only at its end.  Rows are therefore kept in blocks, which are
// given back one by one while the builder takes the rows over; they are large enough for the
// allocator to return them to the system, so that the arcs are never in memory twice.

namespace nda::io {
namespace {

constexpr std::size_t kRowsPerBlock = std::size_t{1} << 16;

struct Block {
  std::vector<Index> indices;  // N per row
  std::vector<double> costs;
};

class CsvReader {
 public:
  CsvReader(Scanner& scanner, const ReadOptions& options) : scanner_(scanner), options_(options) {
    scanner_.set_comma_delimited();
  }

  Problem read() {
    read_header();
    while (scanner_.next_line()) read_row();
    check_sizes(scanner_, options_, sizes_);
    return build();
  }

 private:
  // Fields may be quoted, as R and pandas can do it.
  std::string header_field() {
    std::string field(scanner_.word());
    for (std::size_t i = 0; i < field.size(); ++i) scanner_.advance();
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = field.substr(1, field.size() - 2);
    }
    return field;
  }

  void read_header() {
    if (!scanner_.next_line()) {
      scanner_.fail("expected the header 'i1,...,iN,cost', found the end of the file");
    }
    for (;;) {
      const std::string expected = std::string("i").append(std::to_string(sizes_.size() + 1));
      const std::string field = header_field();
      if (field == "cost") break;
      if (field != expected) {
        scanner_.fail("expected column '" + expected + "' or 'cost' in the header, found " +
                      in_quotes(field));
      }
      sizes_.push_back(0);
      expect_comma();
    }
    const std::size_t n = sizes_.size();
    if (n < 2 || n > static_cast<std::size_t>(kMaxDimensions)) {
      scanner_.fail(std::to_string(n) + " dimensions given, 2 to " +
                    std::to_string(kMaxDimensions) + " allowed");
    }
    scanner_.finish_line();
  }

  void read_row() {
    if (blocks_.empty() || blocks_.back().costs.size() == kRowsPerBlock) add_block();
    Block& block = blocks_.back();
    bool any_real = false;
    for (std::size_t k = 0; k < sizes_.size(); ++k) {
      const Index index = read_index(k);
      any_real = any_real || index != 0;
      if (index > sizes_[k]) enlarge(k, index);
      block.indices.push_back(index);
      expect_comma();
    }
    if (!any_real) scanner_.fail("all indices of the tuple are 0");
    block.costs.push_back(read_cost(scanner_));
    scanner_.finish_line();
  }

  void add_block() {
    const std::size_t least_bytes = 2 * sizes_.size() + 1;  // "0,0,0" without its newline
    const std::size_t num_rows = std::min(kRowsPerBlock, scanner_.max_bytes() / least_bytes + 1);
    blocks_.emplace_back();
    blocks_.back().indices.reserve(num_rows * sizes_.size());
    blocks_.back().costs.reserve(num_rows);
  }

  void enlarge(std::size_t k, Index size) {
    sizes_[k] = size;
    check_sizes(scanner_, options_, sizes_);
  }

  Index read_index(std::size_t k) {
    std::uint64_t index = 0;
    constexpr std::uint64_t kLargest = std::numeric_limits<Index>::max();
    if (!scanner_.read_unsigned(index) || index > kLargest) {
      scanner_.fail("expected an index of dimension " + std::to_string(k + 1) +
                    ", a whole number up to " + std::to_string(kLargest) + ", found " +
                    (index > kLargest ? std::to_string(index) : scanner_.found()));
    }
    return static_cast<Index>(index);
  }

  void expect_comma() {
    scanner_.skip_blanks();
    if (scanner_.peek() != ',') scanner_.fail("expected a comma, found " + scanner_.found());
    scanner_.advance();
  }

  Problem build() {
    const std::size_t n = sizes_.size();
    ProblemBuilder builder(sizes_);
    if (!blocks_.empty()) {
      builder.reserve((blocks_.size() - 1) * kRowsPerBlock + blocks_.back().costs.size());
    }
    for (; !blocks_.empty(); blocks_.pop_front()) {
      const Block& block = blocks_.front();
      for (std::size_t row = 0; row < block.costs.size(); ++row) {
        builder.add_arc(std::span(block.indices).subspan(row * n, n), block.costs[row]);
      }
    }
    return std::move(builder).build();
  }

  Scanner& scanner_;
  const ReadOptions& options_;
  std::vector<Index> sizes_;  // N, largest index seen
  std::deque<Block> blocks_;
};

}  // namespace

Problem read_csv(Scanner& scanner, const ReadOptions& options) {
  return CsvReader(scanner, options).read();
}

}  // namespace nda::io
