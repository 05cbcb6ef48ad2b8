#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "nda/io.hpp"
#include "nda/problem.hpp"

namespace nda::io {

/// The message of the InputError that an action throws.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// A folder that disappears with all it holds.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "nda-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  /// Names of the files in it.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

 private:
  std::filesystem::path path_;
};

inline std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write_file(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// The bytes of a problem in a format.
inline std::string text_of(const Problem& problem, FileFormat format) {
  std::ostringstream text;
  write_problem(problem, text, {format});
  return text.str();
}

/// Everything but the counters of what was dropped.
inline ::testing::AssertionResult same_problem(const Problem& a, const Problem& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end());
  };
  if (!equal(a.sizes(), b.sizes())) return ::testing::AssertionFailure() << "sizes differ";
  for (int k = 0; k < a.num_dimensions(); ++k) {
    if (!equal(a.indices(k), b.indices(k))) {
      return ::testing::AssertionFailure() << "indices of dimension " << k + 1 << " differ";
    }
    if (!equal(a.singleton_costs(k), b.singleton_costs(k))) {
      return ::testing::AssertionFailure() << "singletons of dimension " << k + 1 << " differ";
    }
    if (!equal(a.use_bounds(k), b.use_bounds(k))) {
      return ::testing::AssertionFailure() << "bounds of dimension " << k + 1 << " differ";
    }
  }
  if (!equal(a.costs(), b.costs())) return ::testing::AssertionFailure() << "costs differ";
  return ::testing::AssertionSuccess();
}

/// A cost of one of several kinds: whole, few digits, all 53 bits, huge or tiny.
inline double random_cost(core::Random& random) {
  const double uniform = random.uniform(-100, 100);
  switch (random.below(5)) {
    case 0:
      return std::floor(uniform);
    case 1:
      return std::floor(uniform * 1000) / 1000;
    case 2:
      return uniform;
    case 3:
      return uniform * 1e300;
    default:
      return uniform * 1e-310;
  }
}

/// Any problem with N from 2 to max_dimensions: sizes 0..5, priced and forbidden singletons.
inline Problem random_problem(std::uint64_t seed, int max_dimensions) {
  core::Random random(seed);
  std::vector<Index> sizes(2 + random.below(static_cast<std::uint64_t>(max_dimensions) - 1));
  for (Index& size : sizes) size = static_cast<Index>(random.below(6));
  ProblemBuilder builder(sizes);
  const std::uint64_t num_arcs = random.below(60);
  std::vector<Index> tuple(sizes.size());
  for (std::uint64_t a = 0; a < num_arcs; ++a) {
    Index any = 0;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      tuple[k] = random.below(3) == 0 ? 0 : static_cast<Index>(random.below(sizes[k] + 1));
      any |= tuple[k];
    }
    if (any == 0) continue;
    builder.add_arc(tuple, random.below(20) == 0 ? kInfinity : random_cost(random));
  }
  return std::move(builder).build();
}

}  // namespace nda::io
