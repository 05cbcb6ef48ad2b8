#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

#include "io/sink.hpp"
#include "nda/types.hpp"

// A file is written beside its final place and renamed, which POSIX makes atomic within a folder.
// Links are followed first, or the rename would replace the link.  What is not a regular file
// (/dev/stdout, a pipe) must not be replaced at all and is written directly.

namespace nda::io {
namespace {

[[noreturn]] void fail(const char* what) {
  throw InputError(std::string(what) + ": " + std::strerror(errno));
}

void write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      fail("cannot write");
    }
  }
}

class DirectSink : public Sink {
 public:
  explicit DirectSink(int file) : file_(file) {}
  DirectSink(const DirectSink&) = delete;
  DirectSink& operator=(const DirectSink&) = delete;
  ~DirectSink() override {
    if (file_ > STDERR_FILENO) ::close(file_);
  }

  void write(std::string_view bytes) override { write_all(file_, bytes); }
  void commit() override {
    if (file_ <= STDERR_FILENO) return;
    const int file = file_;
    file_ = -1;
    if (::close(file) != 0) fail("cannot write");
  }

 private:
  int file_;
};

class RenamedSink : public Sink {
 public:
  explicit RenamedSink(std::string path) : path_(std::move(path)) {
    do {
      static std::atomic<unsigned> counter = 0;
      temporary_ = path_ + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
      file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (file_ < 0 && errno == EEXIST);
    if (file_ < 0) fail("cannot write");
  }
  RenamedSink(const RenamedSink&) = delete;
  RenamedSink& operator=(const RenamedSink&) = delete;
  ~RenamedSink() override {
    if (file_ >= 0) ::close(file_);
    if (!committed_) ::unlink(temporary_.c_str());
  }

  void set_mode(mode_t mode) { ::fchmod(file_, mode); }
  void write(std::string_view bytes) override { write_all(file_, bytes); }
  void commit() override {
    const int file = file_;
    file_ = -1;
    if (::close(file) != 0) fail("cannot write");
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot write");
    committed_ = true;
  }

 private:
  std::string path_;
  std::string temporary_;
  int file_ = -1;
  bool committed_ = false;
};

std::unique_ptr<Sink> replacing_sink(const std::string& path, mode_t mode) {
  if (::access(path.c_str(), W_OK) != 0) fail("cannot write");
  std::error_code error;
  const std::filesystem::path target = std::filesystem::canonical(path, error);
  if (error) throw InputError("cannot write: " + error.message());
  auto sink = std::make_unique<RenamedSink>(target.string());
  sink->set_mode(mode & 07777);
  return sink;
}

}  // namespace

std::unique_ptr<Sink> file_sink(const std::string& path) {
  if (path == "-") return std::make_unique<DirectSink>(STDOUT_FILENO);
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return std::make_unique<RenamedSink>(path);
  if (S_ISREG(status.st_mode)) return replacing_sink(path, status.st_mode);
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail("cannot write");
  return std::make_unique<DirectSink>(file);
}

}  // namespace nda::io
