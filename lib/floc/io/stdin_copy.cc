#include "floc/io/stdin_copy.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "floc/base/error.h"
#include "floc/base/read_file.h"

namespace floc {

StdinCopy::StdinCopy() {
  read_pieces("-", [&](std::string_view piece) {
    if (!write_all(file_.descriptor(), piece)) throw IoError(file_.path(), std::strerror(errno));
  });
  if (std::freopen(file_.path().c_str(), "rb", stdin) == nullptr)
    throw IoError(file_.path(), std::strerror(errno));
}

}  // namespace floc
