#pragma once

#include <stop_token>
#include <string>
#include <vector>

namespace nda::mip {

/// How a child process ended.
enum class Ending {
  kExited,       ///< by itself; see exit_code
  kTimeLimit,    ///< killed at the limit
  kInterrupted,  ///< killed because a stop was requested
  kNotStarted,   ///< the program cannot be run
};

struct ProcessResult {
  Ending ending = Ending::kNotStarted;
  int exit_code = -1;  ///< 128 + signal when a signal ended it
  double seconds = 0;  ///< wall time from start to end, to about 1 %
};

/// Runs a program and waits for it.
///
/// The child works in `folder`, reads nothing, and writes both of its outputs to the file `log`
/// there.  It leads a process group of its own, with default signal handling, and the whole group
/// is killed (SIGKILL) at the limit or on request, and what it left behind when it ended by itself.
///
/// @param arguments  the program, with its path, and what it is given; not empty.
/// @param limit_s    above 0; may be infinite.
/// @param log        a file name without folders.
ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::string& folder,
                          const std::string& log,
                          double limit_s,
                          const std::stop_token& stop = {});

}  // namespace nda::mip
