#pragma once

#include <span>
#include <string_view>

namespace nda::fuzz {

/// One entry point into the readers.  run() takes any bytes, says whether the reader accepted them,
/// and throws std::logic_error when the reader breaks a promise: an error is an InputError of one
/// printable line, an accepted input survives being written and read again.
struct Target {
  const char* name;  ///< also the folder of its seeds in tests/fuzz/corpus
  bool (*run)(std::string_view bytes);
};

/// nda, gzip, dense, csv, solution, proof, warm_start.
std::span<const Target> targets();

}  // namespace nda::fuzz
