# base/version.cc asks for the commit at build time, so that a rebuilt program never names an old one.
set(floc_commit_header "${CMAKE_CURRENT_BINARY_DIR}/floc_commit.h")
add_custom_target(floc_commit
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DOUTPUT=${floc_commit_header}
          -P ${PROJECT_SOURCE_DIR}/lib/cmake/WriteCommit.cmake
  BYPRODUCTS ${floc_commit_header} VERBATIM)
add_dependencies(floc_base floc_commit)
target_include_directories(floc_base PRIVATE "${CMAKE_CURRENT_BINARY_DIR}")
set_source_files_properties(version.cc PROPERTIES COMPILE_DEFINITIONS FLOC_VERSION="${PROJECT_VERSION}")
