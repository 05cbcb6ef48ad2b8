#include "mip/comparison_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace nda::mip {
namespace {

// Ten significant digits of the largest figure, the same number of decimals in the whole table.
class FigureFormat {
 public:
  explicit FigureFormat(const FileComparison& comparison) {
    double largest = 0;
    for (const MethodResult& result : comparison.results) {
      for (const double value : {result.cost, result.bound}) {
        if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
      }
    }
    scientific_ = largest > 0 && (largest < 1e-3 || largest >= 1e15);
    const int exponent = largest > 0 ? static_cast<int>(std::floor(std::log10(largest))) : 0;
    decimals_ = scientific_ ? 9 : std::clamp(9 - exponent, 0, 6);
  }

  std::string operator()(double value) const {
    if (!std::isfinite(value)) return "-";
    char text[48];
    std::snprintf(text, sizeof text, scientific_ ? "%.*e" : "%.*f", decimals_, value);
    return text;
  }

 private:
  bool scientific_ = false;
  int decimals_ = 6;
};

std::string format(const char* pattern, double value) {
  if (!std::isfinite(value)) return "-";
  char text[48];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string percent(double share) {
  return format("%.4f", 100 * share + 0.0);
}

// By how much a cost exceeds the best one.
double excess(const FileComparison& comparison, const MethodResult& result) {
  const double best = comparison.best_cost();
  if (!result.has_solution()) return kInfinity;
  if (same_value(comparison, result.cost, best)) return 0;
  return (result.cost - best) / std::max(1e-9, std::abs(best));
}

using Cells = std::vector<std::string>;

// Columns as wide as their widest cell; those in `left` flush left.
std::string aligned(const std::vector<Cells>& rows, const std::string& left) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Cells& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const Cells& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string pad(widths[c] - row[c].size(), ' ');
      if (c > 0) line += "  ";
      line += left[c] == 'l' ? row[c] + pad : pad + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

bool has_run(const MethodResult& result) {
  return result.status != "skipped" && result.status != "interrupted";
}

Cells method_row(const FileComparison& comparison,
                 const MethodResult& result,
                 const FigureFormat& figure) {
  const auto mark = [&](double value, double best) {
    return std::isfinite(value) && same_value(comparison, value, best) ? " *" : "  ";
  };
  return {result.method,
          figure(result.cost) + mark(result.cost, comparison.best_cost()),
          percent(excess(comparison, result)),
          figure(result.bound) + mark(result.bound, comparison.best_bound()),
          percent(std::max(0.0, result.relative_gap())),
          has_run(result) ? format("%.4f", result.seconds) : "-",
          result.status,
          result.proven ? "yes" : "-",
          result.note};
}

// Figures of one method over all files.
struct Total {
  std::size_t run = 0;
  std::size_t solved = 0;
  std::size_t proven = 0;
  std::size_t best = 0;
  double worst_excess = 0;
  double sum_excess = 0;
  double seconds = 0;
  double sum_log_seconds = 0;
};

Total total_of(const std::vector<FileComparison>& comparisons, std::size_t method) {
  Total total;
  for (const FileComparison& comparison : comparisons) {
    const MethodResult& result = comparison.results[method];
    if (!has_run(result)) continue;
    ++total.run;
    total.proven += result.proven;
    total.seconds += result.seconds;
    total.sum_log_seconds += std::log(std::max(1e-6, result.seconds));
    if (!result.has_solution()) continue;
    const double over = excess(comparison, result);
    ++total.solved;
    total.best += over == 0;
    total.sum_excess += over;
    total.worst_excess = std::max(total.worst_excess, over);
  }
  return total;
}

Cells total_row(const std::string& method, const Total& total) {
  const double run = static_cast<double>(total.run);
  const bool any = total.run > 0;
  const bool any_solved = total.solved > 0;
  return {method,
          std::to_string(total.run),
          std::to_string(total.solved),
          std::to_string(total.best),
          std::to_string(total.proven),
          any_solved ? percent(total.sum_excess / static_cast<double>(total.solved)) : "-",
          any_solved ? percent(total.worst_excess) : "-",
          any ? format("%.4f", std::exp(total.sum_log_seconds / run)) : "-",
          any ? format("%.4f", total.seconds) : "-"};
}

}  // namespace

std::string comparison_table(const FileComparison& comparison) {
  const std::size_t indices =
      std::accumulate(comparison.sizes.begin(), comparison.sizes.end(), std::size_t{0});
  std::string text = comparison.file + ": " + std::to_string(comparison.sizes.size()) +
                     " dimensions, " + std::to_string(indices) + " indices, " +
                     std::to_string(comparison.num_arcs) + " arcs\n";
  const FigureFormat figure(comparison);
  std::vector<Cells> rows = {{"method",
                              "cost  ",
                              "excess %",
                              "lower bound  ",
                              "gap %",
                              "seconds",
                              "status",
                              "proven",
                              ""}};
  for (const MethodResult& result : comparison.results) {
    rows.push_back(method_row(comparison, result, figure));
  }
  return text + aligned(rows, "lrrrrrlll");
}

std::string summary_table(const std::vector<FileComparison>& comparisons) {
  std::vector<Cells> rows = {{"method",
                              "files",
                              "solved",
                              "best",
                              "proven",
                              "mean excess %",
                              "worst %",
                              "geo-mean s",
                              "total s"}};
  for (std::size_t m = 0; m < comparisons.front().results.size(); ++m) {
    rows.push_back(total_row(comparisons.front().results[m].method, total_of(comparisons, m)));
  }
  return std::to_string(comparisons.size()) + " files\n" + aligned(rows, "lrrrrrrrr");
}

}  // namespace nda::mip
