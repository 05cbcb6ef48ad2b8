#include "mip/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include "core/clock.hpp"

// A child is waited for by asking again and again whether it has ended, in intervals of 1 % of the
// time it has run (0.2 to 10 ms): precise enough for a table, needs no signal handler and no thread
// of ours, and so disturbs nothing in a program that uses the library.

namespace nda::mip {
namespace {

// Attributes and file actions of posix_spawn, released when they go out of scope.
class SpawnPlan {
 public:
  SpawnPlan(const std::string& folder, const std::string& log) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(
        &actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  bool start(const std::vector<std::string>& arguments, pid_t& child) const {
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) {
      pointers.push_back(const_cast<char*>(argument.c_str()));
    }
    pointers.push_back(nullptr);
    return posix_spawn(&child, pointers[0], &actions_, &attributes_, pointers.data(), environ) == 0;
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

// True when the child has ended; it stays a zombie, so that its process group keeps its number.
bool has_ended(pid_t child) {
  siginfo_t info{};
  int answer = -1;
  do {
    answer = waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
  } while (answer < 0 && errno == EINTR);
  return answer < 0 || info.si_pid == child;
}

// Ends the whole group and returns the exit code of its leader.
int bury(pid_t child) {
  kill(-child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void pause(double elapsed_s) {
  std::this_thread::sleep_for(
      std::chrono::duration<double>(std::clamp(0.01 * elapsed_s, 2e-4, 1e-2)));
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::string& folder,
                          const std::string& log,
                          double limit_s,
                          const std::stop_token& stop) {
  ProcessResult result;
  pid_t child = 0;
  const core::Deadline deadline(limit_s, stop);
  if (!SpawnPlan(folder, log).start(arguments, child)) return result;
  result.ending = Ending::kExited;
  while (!has_ended(child)) {
    if (deadline.reached()) {
      result.ending = deadline.interrupted() ? Ending::kInterrupted : Ending::kTimeLimit;
      break;
    }
    pause(deadline.seconds());
  }
  result.seconds = deadline.seconds();
  result.exit_code = bury(child);
  return result;
}

}  // namespace nda::mip
