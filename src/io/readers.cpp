#include "io/readers.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "nda/types.hpp"

namespace nda::io {
namespace {

constexpr std::uint64_t kMaxIndices = std::uint64_t{1} << 28;

std::string backing(const Scanner& scanner) {
  return "a file of at most " + std::to_string(scanner.max_bytes()) + " bytes";
}

}  // namespace

void check_sizes(const Scanner& scanner,
                 const ReadOptions& options,
                 const std::vector<Index>& sizes) {
  const std::uint64_t sum = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
  if (sum > kMaxIndices) {
    scanner.fail(std::to_string(sum) + " indices declared, at most " + std::to_string(kMaxIndices) +
                 " are supported");
  }
  const std::uint64_t spare = options.spare_indices;
  if (sum > spare && sum - spare > scanner.max_bytes()) {
    scanner.fail(std::to_string(sum) + " indices declared, too many for " + backing(scanner) +
                 " (at most one per byte and " + std::to_string(spare) + " more)");
  }
}

void check_backed(const Scanner& scanner,
                  std::uint64_t num_items,
                  std::size_t least_bytes,
                  const char* what) {
  if (num_items > scanner.max_bytes() / least_bytes) {
    scanner.fail(std::to_string(num_items) + " " + what + " announced, too many for " +
                 backing(scanner));
  }
}

int read_num_dimensions(Scanner& scanner) {
  std::uint64_t value = 0;
  if (scanner.read_unsigned(value) && value >= 2 && value <= kMaxDimensions) {
    return static_cast<int>(value);
  }
  if (value == 0) {
    scanner.fail("expected the number of dimensions, a whole number from 2 to " +
                 std::to_string(kMaxDimensions) + ", found " + scanner.found());
  }
  scanner.fail(std::to_string(value) + " dimensions given, 2 to " + std::to_string(kMaxDimensions) +
               " allowed");
}

std::uint64_t read_whole(Scanner& scanner, const std::string& what, std::uint64_t largest) {
  std::uint64_t value = 0;
  if (!scanner.read_unsigned(value)) {
    scanner.fail("expected " + what + ", a whole number up to " + std::to_string(largest) +
                 ", found " + scanner.found());
  }
  if (value > largest) {
    scanner.fail(what + " is " + std::to_string(value) + ", at most " + std::to_string(largest) +
                 " allowed");
  }
  return value;
}

double read_cost(Scanner& scanner) {
  double cost = 0;
  if (!scanner.read_double(cost)) {
    scanner.fail("expected a cost within the range of double, found " + scanner.found());
  }
  if (std::isnan(cost) || cost == -kInfinity) {
    scanner.fail(std::string("cost is ") + (std::isnan(cost) ? "NaN" : "-inf"));
  }
  return cost;
}

}  // namespace nda::io
