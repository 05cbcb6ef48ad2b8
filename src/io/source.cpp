#include "io/source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "nda/types.hpp"

namespace nda::io {
namespace {

class MemorySource : public Source {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes), size_(bytes.size()) {}

  std::size_t read(char* buffer, std::size_t size) override {
    const std::size_t count = std::min(size, bytes_.size());
    std::copy_n(bytes_.data(), count, buffer);
    bytes_.remove_prefix(count);
    return count;
  }
  std::size_t max_bytes() const override { return size_; }
  std::size_t likely_bytes() const override { return size_; }

 private:
  std::string_view bytes_;
  std::size_t size_;
};

class StreamSource : public Source {
 public:
  explicit StreamSource(std::istream& input) : input_(input) {}

  std::size_t read(char* buffer, std::size_t size) override {
    input_.read(buffer, static_cast<std::streamsize>(size));
    if (input_.bad()) throw InputError("cannot read the stream");
    return static_cast<std::size_t>(input_.gcount());
  }
  std::size_t max_bytes() const override { return kUnknown; }
  std::size_t likely_bytes() const override { return 0; }

 private:
  std::istream& input_;
};

class FileSource : public Source {
 public:
  explicit FileSource(const std::string& path)
      : file_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)),
        owned_(path != "-") {
    if (file_ < 0) fail("cannot open");
    struct stat status = {};
    if (::fstat(file_, &status) != 0) return;
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::size_t>(status.st_size);
    if (S_ISDIR(status.st_mode)) {
      if (owned_) ::close(file_);
      errno = EISDIR;
      fail("cannot read");
    }
  }
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override {
    if (owned_) ::close(file_);
  }

  std::size_t read(char* buffer, std::size_t size) override {
    ssize_t count = 0;
    do {
      count = ::read(file_, buffer, size);
    } while (count < 0 && errno == EINTR);
    if (count < 0) fail("cannot read");
    return static_cast<std::size_t>(count);
  }
  std::size_t max_bytes() const override { return size_; }
  std::size_t likely_bytes() const override { return size_ == kUnknown ? 0 : size_; }

 private:
  [[noreturn]] static void fail(const char* what) {
    throw InputError(std::string(what) + ": " + std::strerror(errno));
  }

  int file_;
  bool owned_;
  std::size_t size_ = kUnknown;
};

}  // namespace

std::unique_ptr<Source> memory_source(std::string_view bytes) {
  return std::make_unique<MemorySource>(bytes);
}

std::unique_ptr<Source> stream_source(std::istream& input) {
  return std::make_unique<StreamSource>(input);
}

std::unique_ptr<Source> file_source(const std::string& path) {
  return std::make_unique<FileSource>(path);
}

std::string input_name(const std::string& path) {
  return path == "-" ? "standard input" : path;
}

}  // namespace nda::io
