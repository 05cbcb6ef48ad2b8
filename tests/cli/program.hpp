#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "io/io_support.hpp"

namespace nda::cli {

/// What a run of the program left behind.
struct Outcome {
  int code = 0;  ///< exit code, or -1 when a signal ended it
  std::string output;
  std::string log;  ///< standard error
};

/// Runs a shell command in which `nda` stands for the program under test, and any file of the
/// folder for itself.
inline Outcome run(const io::TemporaryFolder& folder, const std::string& command) {
  const std::string output = folder / ".output";
  const std::string log = folder / ".log";
  const std::string script = "cd '" + (folder / "") +
                             "' && nda() { '" NDA_PROGRAM "' \"$@\"; }; ( " + command + " ) > " +
                             output + " 2> " + log;
  const int status = std::system(script.c_str());
  const Outcome outcome = {
      WIFEXITED(status) ? WEXITSTATUS(status) : -1, io::contents(output), io::contents(log)};
  std::filesystem::remove(output);
  std::filesystem::remove(log);
  return outcome;
}

}  // namespace nda::cli
