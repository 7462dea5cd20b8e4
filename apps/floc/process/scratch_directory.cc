#include "process/scratch_directory.h"

#include <cstdlib>
#include <filesystem>

#include "floc/base/error.h"

namespace floc {

namespace fs = std::filesystem;

ScratchDirectory::ScratchDirectory() : path_((fs::temp_directory_path() / "floc-XXXXXX").string()) {
  if (::mkdtemp(path_.data()) == nullptr) throw IoError(path_, "this temporary directory cannot be made");
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace floc
