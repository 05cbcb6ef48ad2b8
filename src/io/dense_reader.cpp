#include <limits>
#include <string>
#include <vector>

#include "io/readers.hpp"
#include "nda/types.hpp"

namespace nda::io {
namespace {

// s^n, or one more than `largest` when it is larger.
std::uint64_t power(std::uint64_t s, int n, std::uint64_t largest) {
  std::uint64_t result = 1;
  for (int k = 0; k < n; ++k) {
    if (s != 0 && result > largest / s) return largest + 1;
    result *= s;
  }
  return result;
}

// The next tuple of real indices, last index fastest.
void increment(std::vector<Index>& tuple, Index size) {
  for (std::size_t k = tuple.size(); k-- > 0;) {
    if (++tuple[k] <= size) return;
    tuple[k] = 1;
  }
}

void forbid_singletons(ProblemBuilder& builder, int n, Index size) {
  std::vector<Index> tuple(static_cast<std::size_t>(n), 0);
  for (Index& index : tuple) {
    for (index = 1; index <= size; ++index) builder.add_arc(tuple, kInfinity);
    index = 0;
  }
}

}  // namespace

Problem read_dense(Scanner& scanner, const ReadOptions& options) {
  constexpr std::uint64_t kLargest = std::numeric_limits<Index>::max();
  if (!scanner.next_word()) scanner.fail("expected 'N s', found the end of the file");
  const int n = read_num_dimensions(scanner);
  const auto size = static_cast<Index>(read_whole(scanner, "the size of the dimensions", kLargest));
  const std::uint64_t num_costs = power(size, n, kLargest);
  if (num_costs > kLargest) {
    scanner.fail(std::to_string(size) + "^" + std::to_string(n) + " costs announced, at most " +
                 std::to_string(kLargest) + " are supported");
  }
  const std::vector<Index> sizes(static_cast<std::size_t>(n), size);
  check_sizes(scanner, options, sizes);
  check_backed(scanner, num_costs, 2, "costs");

  ProblemBuilder builder(sizes);
  builder.reserve(std::min<std::size_t>(num_costs, scanner.likely_bytes() / 2));
  forbid_singletons(builder, n, size);
  std::vector<Index> tuple(sizes.size(), 1);
  for (std::uint64_t a = 0; a < num_costs; ++a) {
    if (!scanner.next_word()) {
      scanner.fail("the file ends after " + std::to_string(a) + " costs, " +
                   std::to_string(num_costs) + " announced");
    }
    add_arc(builder, scanner, tuple, read_cost(scanner));
    increment(tuple, size);
  }
  if (scanner.next_word()) {
    scanner.fail("unexpected " + scanner.found() + " after the last of " +
                 std::to_string(num_costs) + " costs");
  }
  return std::move(builder).build();
}

}  // namespace nda::io
