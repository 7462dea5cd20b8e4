#include "floc/base/gzip_stream.h"

#include <zlib.h>

#include <utility>
#include <vector>

#include "floc/base/error.h"

namespace floc {

struct GzipStream::Inflater {
  z_stream stream = {};
};

namespace {

constexpr int kGzipFormat = 16 + MAX_WBITS;  // zlib's argument "windowBits": gzip header, largest window

}  // namespace

bool is_gzip(std::string_view beginning) {
  return beginning.starts_with("\x1f\x8b\x08");
}

std::string inflated_by_zlib(const std::string& place, std::string_view data, std::size_t size) {
  // zlib compresses by a factor of at most 1032. If `size` implies a factor above 1100, `size` is wrong, and no memory
  // is allocated.
  constexpr std::size_t kLargestFactor = 1100;
  uLongf length = size / kLargestFactor > data.size() ? 0 : size;
  std::string bytes(length, '\0');
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                                reinterpret_cast<const Bytef*>(data.data()), data.size());
  if (status != Z_OK || length != size) throw InputError(place, "the compressed data are damaged");
  return bytes;
}

GzipStream::GzipStream(std::string place) : place_(std::move(place)), inflater_(new Inflater) {
  if (inflateInit2(&inflater_->stream, kGzipFormat) != Z_OK)
    throw InputError(place_, "there is no memory to decompress the file");
}

GzipStream::~GzipStream() {
  inflateEnd(&inflater_->stream);
}

void GzipStream::pass(std::string_view piece, const std::function<void(std::string_view)>& take) {
  z_stream& stream = inflater_->stream;
  std::vector<char> buffer(std::size_t{1} << 16);
  // The interface of zlib takes a pointer to mutable input, but zlib does not change the input.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
  stream.avail_in = static_cast<uInt>(piece.size());
  do {
    if (ended_ && stream.avail_in > 0) {  // another member follows
      inflateReset(&stream);
      ended_ = false;
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR)
      throw InputError(place_, std::string("the compressed file is damaged: ") +
                                   (stream.msg ? stream.msg : "it is not in the format of gzip"));
    take({buffer.data(), buffer.size() - stream.avail_out});
    ended_ = status == Z_STREAM_END;
  } while (stream.avail_in > 0 || stream.avail_out == 0);
}

void GzipStream::finish() const {
  if (!ended_) throw InputError(place_, "the compressed file is cut short");
}

}  // namespace floc
