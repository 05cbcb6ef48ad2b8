#include "mip/process.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include "mip_support.hpp"
#include "nda/types.hpp"

namespace nda::mip {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

std::string content_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// A killed process may linger as a zombie of init for a moment.
bool dies_soon(pid_t process) {
  for (int tries = 0; tries < 400; ++tries) {
    const std::string status = content_of("/proc/" + std::to_string(process) + "/status");
    if (status.empty() || status.find("State:\tZ") != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST(Process, ReportsTheExitCodeAndCollectsBothOutputs) {
  const Scratch scratch;
  const ProcessResult result = run_process(
      {"/bin/sh", "-c", "echo out; echo error >&2; pwd; exit 7"}, scratch.path(), "log", kNoLimit);
  EXPECT_EQ(result.ending, Ending::kExited);
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(content_of(scratch.file("log")), "out\nerror\n" + scratch.path() + "\n");
}

TEST(Process, MeasuresTheTimeItTakes) {
  const Scratch scratch;
  const ProcessResult result =
      run_process({"/bin/sh", "-c", "sleep 0.2"}, scratch.path(), "log", kNoLimit);
  EXPECT_EQ(result.ending, Ending::kExited);
  EXPECT_GE(result.seconds, 0.2);
}

TEST(Process, GivesTheChildNothingToRead) {
  const Scratch scratch;
  const ProcessResult result =
      run_process({"/bin/sh", "-c", "cat"}, scratch.path(), "log", kNoLimit);
  EXPECT_EQ(result.ending, Ending::kExited);
  EXPECT_EQ(content_of(scratch.file("log")), "");
}

TEST(Process, KillsTheWholeGroupAtTheLimit) {
  const Scratch scratch;
  const ProcessResult result = run_process(
      {"/bin/sh", "-c", "trap '' TERM INT; sleep 60 & echo $!; wait"}, scratch.path(), "log", 0.3);
  EXPECT_EQ(result.ending, Ending::kTimeLimit);
  EXPECT_GE(result.seconds, 0.3);
  EXPECT_LT(result.seconds, 30);
  const int grandchild = std::stoi(content_of(scratch.file("log")));
  EXPECT_TRUE(dies_soon(grandchild));
}

TEST(Process, KillsWhatALeaderLeavesBehind) {
  const Scratch scratch;
  const ProcessResult result =
      run_process({"/bin/sh", "-c", "sleep 60 & echo $!"}, scratch.path(), "log", kNoLimit);
  EXPECT_EQ(result.ending, Ending::kExited);
  EXPECT_TRUE(dies_soon(std::stoi(content_of(scratch.file("log")))));
}

TEST(Process, EndsWhenAStopIsRequested) {
  const Scratch scratch;
  std::stop_source source;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    source.request_stop();
  });
  const ProcessResult result = run_process(
      {"/bin/sh", "-c", "sleep 60"}, scratch.path(), "log", kNoLimit, source.get_token());
  stopper.join();
  EXPECT_EQ(result.ending, Ending::kInterrupted);
  EXPECT_LT(result.seconds, 30);
}

TEST(Process, ReportsASignalAsTheShellDoes) {
  const Scratch scratch;
  const ProcessResult result =
      run_process({"/bin/sh", "-c", "kill -SEGV $$"}, scratch.path(), "log", kNoLimit);
  EXPECT_EQ(result.ending, Ending::kExited);
  EXPECT_EQ(result.exit_code, 128 + SIGSEGV);
}

TEST(Process, SaysSoWhenThereIsNoSuchProgram) {
  const Scratch scratch;
  EXPECT_EQ(run_process({"/no/such/program"}, scratch.path(), "log", 1).ending,
            Ending::kNotStarted);
}

TEST(TemporaryFolder, IsRemovedWithItsContent) {
  const Scratch scratch;
  {
    const TemporaryFolder folder(scratch.path());
    std::ofstream(folder.file("a")) << "text";
    std::filesystem::create_directory(folder.file("b"));
    EXPECT_FALSE(scratch.is_empty());
  }
  EXPECT_TRUE(scratch.is_empty());
}

TEST(TemporaryFolder, NamesTheParentInWhichNothingCanBeMade) {
  try {
    const TemporaryFolder folder("/no/such/folder");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/folder: "), std::string::npos);
  }
}

}  // namespace
}  // namespace nda::mip
