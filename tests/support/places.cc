#include "support/places.h"

namespace floc::test {

std::string source_directory() {
  return FLOC_SOURCE_DIR;
}

std::string jambashbulk_file() {
  return source_directory() + "/data/packings/disks/disks16.txt";
}

std::string demo_tables() {
  return source_directory() + "/data/tables/demo";
}

std::string floc_program() {
  return FLOC_PROGRAM;
}

std::string relaxation_library() {
  return FLOC_RELAXATION_LIBRARY;
}

std::string rigid_library() {
  return FLOC_RIGID_LIBRARY;
}

}  // namespace floc::test
