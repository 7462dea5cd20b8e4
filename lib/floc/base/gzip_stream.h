#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace floc {

/// Whether a file is compressed by gzip. @param beginning  first bytes of the file
bool is_gzip(std::string_view beginning);

/// Decompresses data in zlib's format (RFC 1950).
/// @param size  size of the data before compression (bytes)
/// @throws InputError naming `place` if the data are damaged or have another size
std::string inflated_by_zlib(const std::string& place, std::string_view data, std::size_t size);

/// Decompresses a file in gzip's format (RFC 1952) piece by piece. The file may consist of several gzip members.
class GzipStream {
 public:
  /// @param place  name of the file, for messages
  explicit GzipStream(std::string place);
  ~GzipStream();
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  /// Decompresses the next piece of the file and passes the result to `take`.
  /// @throws InputError if the compressed data are damaged
  void pass(std::string_view piece, const std::function<void(std::string_view)>& take);

  /// Checks that the compressed data have ended. @throws InputError if the file is cut short
  void finish() const;

 private:
  struct Inflater;
  std::string place_;
  std::unique_ptr<Inflater> inflater_;
  bool ended_ = false;
};

}  // namespace floc
