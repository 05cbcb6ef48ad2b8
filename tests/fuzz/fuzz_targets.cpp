#include "fuzz/fuzz_targets.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "nda/io.hpp"

namespace nda::fuzz {
namespace {

// A small allowance for unused indices keeps each run short; the limit is the same code for any.
constexpr std::size_t kSpareIndices = 1000;

void check_message(const std::string& message) {
  const bool printable =
      std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; });
  constexpr std::size_t kLongest = 300;
  if (message.empty() || !printable || message.size() > kLongest) {
    throw std::logic_error("unsuitable message: " + message);
  }
}

template <typename Read>
auto accepted(Read read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const InputError& error) {
    check_message(error.what());
    return std::nullopt;
  }
}

std::string text_of(const Problem& problem, FileFormat format) {
  std::ostringstream text;
  write_problem(problem, text, {format});
  return text.str();
}

bool check_problem(std::string_view bytes, FileFormat format) {
  const ReadOptions options = {format, kSpareIndices};
  const auto problem = accepted([&] { return parse_problem(bytes, options); });
  if (!problem) return false;
  for (const FileFormat other : {FileFormat::kNda, FileFormat::kCsv}) {
    if (other == FileFormat::kCsv && problem->is_many_to_one()) continue;  // is refused
    const std::string text = text_of(*problem, other);
    const Problem again = parse_problem(text, {other});
    if (text_of(again, other) != text || again.num_duplicates() != 0) {
      throw std::logic_error("not restored: " + text);
    }
  }
  text_of(*problem, FileFormat::kLp);
  text_of(*problem, FileFormat::kMps);
  return true;
}

bool run_nda(std::string_view bytes) {
  return check_problem(bytes, FileFormat::kNda);
}
bool run_dense(std::string_view bytes) {
  return check_problem(bytes, FileFormat::kDense);
}
bool run_csv(std::string_view bytes) {
  return check_problem(bytes, FileFormat::kCsv);
}

// A mutation often destroys the magic bytes, so they are put in front as well.
bool run_gzip(std::string_view bytes) {
  check_problem("\x1f\x8b\x08" + std::string(bytes), FileFormat::kNda);
  return check_problem(bytes, FileFormat::kNda);
}

bool run_solution(std::string_view bytes) {
  const auto solution = accepted([&] { return solution_from_json(bytes); });
  if (!solution) return false;
  const std::string text = solution_to_json(*solution);
  if (solution_to_json(solution_from_json(text)) != text) {
    throw std::logic_error("not restored: " + text);
  }
  return true;
}

std::string text_of(const Proof& proof) {
  std::ostringstream text;
  write_proof(proof, text);
  return text.str();
}

bool run_proof(std::string_view bytes) {
  const auto proof = accepted([&] { return parse_proof(bytes); });
  if (!proof) return false;
  const std::string text = text_of(*proof);
  if (text_of(parse_proof(text)) != text) throw std::logic_error("not restored: " + text);
  return true;
}

bool run_warm_start(std::string_view bytes) {
  const auto warm = accepted([&] { return warm_start_from_json(bytes); });
  if (!warm) return false;
  const std::string text = warm_start_to_json(*warm);
  if (warm_start_to_json(warm_start_from_json(text)) != text) {
    throw std::logic_error("not restored: " + text);
  }
  return true;
}

constexpr Target kTargets[] = {
    {"nda", run_nda},
    {"gzip", run_gzip},
    {"dense", run_dense},
    {"csv", run_csv},
    {"solution", run_solution},
    {"proof", run_proof},
    {"warm_start", run_warm_start},
};

}  // namespace

std::span<const Target> targets() {
  return kTargets;
}

}  // namespace nda::fuzz
