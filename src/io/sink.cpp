#include "io/sink.hpp"

#include <charconv>

#include "nda/types.hpp"

namespace nda::io {
namespace {

class StreamSink : public Sink {
 public:
  explicit StreamSink(std::ostream& output) : output_(output) {}

  void write(std::string_view bytes) override {
    output_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!output_) throw InputError("cannot write the stream");
  }
  void commit() override {
    if (!output_.flush()) throw InputError("cannot write the stream");
  }

 private:
  std::ostream& output_;
};

}  // namespace

std::unique_ptr<Sink> stream_sink(std::ostream& output) {
  return std::make_unique<StreamSink>(output);
}

TextWriter& TextWriter::operator<<(std::uint64_t value) {
  char text[24];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return *this << std::string_view(text, static_cast<std::size_t>(result.ptr - text));
}

TextWriter& TextWriter::operator<<(double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return *this << std::string_view(text, static_cast<std::size_t>(result.ptr - text));
}

}  // namespace nda::io
