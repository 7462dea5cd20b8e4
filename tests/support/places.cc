#include "support/places.h"

namespace floc::test {

std::string source_directory() {
  return FLOC_SOURCE_DIR;
}

std::string floc_program() {
  return FLOC_PROGRAM;
}

std::string relaxation_library() {
  return FLOC_RELAXATION_LIBRARY;
}

}  // namespace floc::test
