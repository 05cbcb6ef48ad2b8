#include <cmath>
#include <cstdio>
#include <numeric>

#include "mip/comparison_text.hpp"

namespace nda::mip {
namespace {

std::string figure(double value) {
  if (!std::isfinite(value)) return "";
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// Quoted where the text would break the row.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string csv_header() {
  return "file,dimensions,indices,arcs,method,kind,status,proven,cost,lower_bound,relative_gap,"
         "seconds,time_limit,note\n";
}

std::string csv_rows(const FileComparison& comparison, double time_limit_s) {
  const std::size_t indices =
      std::accumulate(comparison.sizes.begin(), comparison.sizes.end(), std::size_t{0});
  const std::string instance =
      field(comparison.file) + "," + std::to_string(comparison.sizes.size()) + "," +
      std::to_string(indices) + "," + std::to_string(comparison.num_arcs) + ",";
  std::string text;
  for (const MethodResult& result : comparison.results) {
    text += instance + result.method + "," + to_string(result.kind) + "," + result.status + "," +
            (result.proven ? "yes" : "no") + "," + figure(result.cost) + "," +
            figure(result.bound) + "," + figure(result.relative_gap()) + "," +
            figure(result.seconds) + "," + figure(time_limit_s) + "," + field(result.note) + "\n";
  }
  return text;
}

}  // namespace nda::mip
