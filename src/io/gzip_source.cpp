#include <zlib.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/source.hpp"
#include "nda/types.hpp"

// Decompression of RFC 1952 files with zlib's inflate, which checks length and CRC of each member.
// gzip files may be concatenated (pigz and bgzip make such files), so after a member another may
// begin; anything else there is an error, where the gzip tool would only warn.  Deflate cannot
// expand more than 1032 times, which turns the size of the file into a bound on its content.

namespace nda::io {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 17;
constexpr std::size_t kMaxExpansion = 1032;
constexpr std::size_t kLikelyExpansion = 3;
constexpr unsigned char kMagic[2] = {0x1f, 0x8b};

bool has_magic(const unsigned char* bytes, std::size_t count) {
  return count >= 2 && bytes[0] == kMagic[0] && bytes[1] == kMagic[1];
}

std::size_t scaled(std::size_t bytes, std::size_t factor) {
  return bytes > Source::kUnknown / factor ? Source::kUnknown : bytes * factor;
}

// Gives back the bytes that were read to look for the magic.
class PeekedSource : public Source {
 public:
  explicit PeekedSource(std::unique_ptr<Source> inner) : inner_(std::move(inner)) {
    while (count_ < peeked_.size()) {
      const std::size_t more = inner_->read(peeked_.data() + count_, peeked_.size() - count_);
      if (more == 0) break;
      count_ += more;
    }
  }

  bool is_gzip() const {
    return has_magic(reinterpret_cast<const unsigned char*>(peeked_.data()), count_);
  }
  std::size_t read(char* buffer, std::size_t size) override {
    if (given_ == count_) return inner_->read(buffer, size);
    const std::size_t count = std::min(size, count_ - given_);
    std::copy_n(peeked_.data() + given_, count, buffer);
    given_ += count;
    return count;
  }
  std::size_t max_bytes() const override { return inner_->max_bytes(); }
  std::size_t likely_bytes() const override { return inner_->likely_bytes(); }

 private:
  std::unique_ptr<Source> inner_;
  std::array<char, 2> peeked_ = {};
  std::size_t count_ = 0;
  std::size_t given_ = 0;
};

class GzipSource : public Source {
 public:
  explicit GzipSource(std::unique_ptr<Source> inner) : inner_(std::move(inner)), block_(kBlock) {
    constexpr int kGzipOnly = 15 + 16;
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw std::bad_alloc();
  }
  GzipSource(const GzipSource&) = delete;
  GzipSource& operator=(const GzipSource&) = delete;
  ~GzipSource() override { inflateEnd(&stream_); }

  std::size_t read(char* buffer, std::size_t size) override {
    stream_.next_out = reinterpret_cast<Bytef*>(buffer);
    stream_.avail_out = static_cast<uInt>(std::min(size, kBlock));
    const uInt wanted = stream_.avail_out;
    while (stream_.avail_out == wanted) {
      if (between_members_ && !begin_member()) return 0;
      if (stream_.avail_in == 0 && !refill()) throw InputError("gzip data ends too early");
      inflate_some();
    }
    return wanted - stream_.avail_out;
  }
  std::size_t max_bytes() const override { return scaled(inner_->max_bytes(), kMaxExpansion); }
  std::size_t likely_bytes() const override {
    return scaled(inner_->likely_bytes(), kLikelyExpansion);
  }

 private:
  // False at the end of the file.
  bool begin_member() {
    if (stream_.avail_in < 2) refill();
    if (stream_.avail_in == 0) return false;
    if (!has_magic(stream_.next_in, stream_.avail_in)) {
      throw InputError("garbage follows the gzip data");
    }
    inflateReset(&stream_);
    between_members_ = false;
    return true;
  }

  // Keeps what is left (at most a byte) and reads on; false when nothing came.
  bool refill() {
    const std::size_t left = stream_.avail_in;
    std::copy_n(stream_.next_in, left, block_.data());
    std::size_t count = left;
    while (count < 2 || count == left) {
      const std::size_t more = inner_->read(block_.data() + count, block_.size() - count);
      if (more == 0) break;
      count += more;
    }
    stream_.next_in = reinterpret_cast<Bytef*>(block_.data());
    stream_.avail_in = static_cast<uInt>(count);
    return count > left;
  }

  void inflate_some() {
    const int code = inflate(&stream_, Z_NO_FLUSH);
    if (code == Z_STREAM_END) {
      between_members_ = true;
    } else if (code == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      const char* what = stream_.msg != nullptr ? stream_.msg : "needs a dictionary";
      throw InputError(std::string("gzip data is corrupt: ") + what);
    }
  }

  std::unique_ptr<Source> inner_;
  std::vector<char> block_;
  z_stream stream_ = {};
  bool between_members_ = false;
};

}  // namespace

std::unique_ptr<Source> decompressed(std::unique_ptr<Source> source) {
  auto peeked = std::make_unique<PeekedSource>(std::move(source));
  if (!peeked->is_gzip()) return peeked;
  return std::make_unique<GzipSource>(std::move(peeked));
}

}  // namespace nda::io
