#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace nda::io {

/// Where bytes go.
class Sink {
 public:
  virtual ~Sink() = default;

  /// Takes all bytes.  Throws InputError on failure.
  virtual void write(std::string_view bytes) = 0;

  /// Makes everything written so far final; to be called once, last.  A sink that dies without it
  /// leaves nothing behind where it can.  Throws InputError on failure.
  virtual void commit() = 0;
};

/// A stream, which must outlive the sink.
std::unique_ptr<Sink> stream_sink(std::ostream& output);

/// A file, or standard output when `path` is "-".  A regular file is written under a temporary name
/// in the same folder and renamed by commit(): readers see the old content or the new, never half
/// of it.  Devices and pipes are written directly.
std::unique_ptr<Sink> file_sink(const std::string& path);

/// Compresses into another sink.  The bytes depend on the content only (no name, no time).
std::unique_ptr<Sink> gzip_sink(std::unique_ptr<Sink> inner);

/// Collects text and hands it on in large pieces.
class TextWriter {
 public:
  /// The sink must outlive the writer.
  explicit TextWriter(Sink& sink) : sink_(sink) { buffer_.reserve(kBuffer + kMargin); }

  TextWriter& operator<<(std::string_view text) {
    buffer_ += text;
    flush_when_full();
    return *this;
  }
  TextWriter& operator<<(char c) {
    buffer_ += c;
    flush_when_full();
    return *this;
  }
  TextWriter& operator<<(std::uint64_t value);

  /// The shortest text that reads back as the same double; "inf" for infinity.
  TextWriter& operator<<(double value);

  /// Hands the rest on.  To be called once, last.
  void finish() {
    sink_.write(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kBuffer = std::size_t{1} << 16;
  static constexpr std::size_t kMargin = 1024;

  void flush_when_full() {
    if (buffer_.size() >= kBuffer) finish();
  }

  Sink& sink_;
  std::string buffer_;
};

}  // namespace nda::io
