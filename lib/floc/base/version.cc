#include "floc/base/version.h"

#include "floc_commit.h"

namespace floc {

std::string version() {
  return FLOC_VERSION;
}

std::string commit() {
  return FLOC_COMMIT;
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "gcc " __VERSION__;
#endif
}

}  // namespace floc
