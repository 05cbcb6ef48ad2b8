#pragma once

#include <cstddef>
#include <istream>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace nda::io {

/// Where bytes come from, in order, once.
class Source {
 public:
  /// max_bytes() of a source that cannot tell.
  static constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();

  virtual ~Source() = default;

  /// Fills up to `size` >= 1 bytes; 0 means the end.  Throws InputError on failure.
  virtual std::size_t read(char* buffer, std::size_t size) = 0;

  /// An upper bound on the bytes that can ever be read, for refusing claims that they cannot back.
  virtual std::size_t max_bytes() const = 0;

  /// A guess of that number to reserve memory by; 0 when there is none.
  virtual std::size_t likely_bytes() const = 0;
};

/// Bytes in memory, which must outlive the source.
std::unique_ptr<Source> memory_source(std::string_view bytes);

/// A stream, which must outlive the source.
std::unique_ptr<Source> stream_source(std::istream& input);

/// A file, or standard input when `path` is "-".
std::unique_ptr<Source> file_source(const std::string& path);

/// The source itself, or its decompressed content when it begins with the gzip magic bytes.
std::unique_ptr<Source> decompressed(std::unique_ptr<Source> source);

/// "standard input" for "-", else the path: how messages call it.
std::string input_name(const std::string& path);

}  // namespace nda::io
