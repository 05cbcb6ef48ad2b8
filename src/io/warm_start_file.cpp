#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "io/json_node.hpp"
#include "io/scanner.hpp"
#include "nda/io.hpp"

namespace nda {
namespace {

using io::JsonNode;

constexpr std::uint64_t kVersion = 1;

// One line per dimension and per tuple.
template <typename Row>
std::string lines(const std::vector<Row>& rows) {
  std::string text = "[";
  for (const Row& row : rows) {
    text += (text.size() > 1 ? ",\n    " : "\n    ") + nlohmann::json(row).dump();
  }
  return text + (rows.empty() ? "]" : "\n  ]");
}

std::vector<double> multipliers(const JsonNode& node) {
  std::vector<double> row;
  for (std::size_t i = 0; i < node.size(); ++i) {
    row.push_back(node[i].number());
    if (!std::isfinite(row.back())) node[i].fail("expected a finite number");
  }
  return row;
}

std::vector<Index> tuple(const JsonNode& node) {
  std::vector<Index> indices;
  for (std::size_t k = 0; k < node.size(); ++k)
    indices.push_back(static_cast<Index>(node[k].whole(std::numeric_limits<Index>::max())));
  return indices;
}

WarmStart read(const JsonNode& file) {
  if (file["format"].text() != "nda-warm-start")
    file["format"].fail("expected \"nda-warm-start\", found " +
                        io::in_quotes(file["format"].text()));
  if (file["version"].whole(kVersion) != kVersion) file["version"].fail("expected 1");
  WarmStart warm;
  const JsonNode rows = file["multipliers"];
  for (std::size_t k = 0; k < rows.size(); ++k) warm.multipliers.push_back(multipliers(rows[k]));
  const JsonNode arcs = file["arcs"];
  for (std::size_t a = 0; a < arcs.size(); ++a) warm.arcs.push_back(tuple(arcs[a]));
  return warm;
}

}  // namespace

std::string warm_start_to_json(const WarmStart& warm_start) {
  for (std::size_t k = 0; k < warm_start.multipliers.size(); ++k) {
    for (const double u : warm_start.multipliers[k]) {
      if (!std::isfinite(u))
        throw InputError("warm start: a multiplier of dimension " + std::to_string(k + 1) +
                         " is not finite");
    }
  }
  return "{\n  \"format\": \"nda-warm-start\",\n  \"version\": 1,\n  \"multipliers\": " +
         lines(warm_start.multipliers) + ",\n  \"arcs\": " + lines(warm_start.arcs) + "\n}\n";
}

WarmStart warm_start_from_json(std::string_view text) {
  const nlohmann::json document = io::parse_json(text);
  return read(JsonNode(document));
}

}  // namespace nda
