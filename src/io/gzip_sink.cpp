#include <zlib.h>

#include <algorithm>
#include <new>
#include <vector>

#include "io/sink.hpp"

namespace nda::io {
namespace {

class GzipSink : public Sink {
 public:
  explicit GzipSink(std::unique_ptr<Sink> inner) : inner_(std::move(inner)), block_(kBlock) {
    constexpr int kGzipFormat = 15 + 16;
    constexpr int kMemoryLevel = 8;
    if (deflateInit2(&stream_,
                     Z_DEFAULT_COMPRESSION,
                     Z_DEFLATED,
                     kGzipFormat,
                     kMemoryLevel,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  GzipSink(const GzipSink&) = delete;
  GzipSink& operator=(const GzipSink&) = delete;
  ~GzipSink() override { deflateEnd(&stream_); }

  void write(std::string_view bytes) override {
    while (!bytes.empty()) {
      const std::size_t count = std::min(bytes.size(), kBlock);
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream_.avail_in = static_cast<uInt>(count);
      compress(Z_NO_FLUSH);
      bytes.remove_prefix(count);
    }
  }
  void commit() override {
    compress(Z_FINISH);
    inner_->commit();
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 17;

  // Takes all input; with Z_FINISH also writes the trailer.
  void compress(int flush) {
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(block_.data());
      stream_.avail_out = static_cast<uInt>(block_.size());
      deflate(&stream_, flush);
      inner_->write({block_.data(), block_.size() - stream_.avail_out});
    } while (stream_.avail_out == 0);
  }

  std::unique_ptr<Sink> inner_;
  std::vector<char> block_;
  z_stream stream_ = {};
};

}  // namespace

std::unique_ptr<Sink> gzip_sink(std::unique_ptr<Sink> inner) {
  return std::make_unique<GzipSink>(std::move(inner));
}

}  // namespace nda::io
