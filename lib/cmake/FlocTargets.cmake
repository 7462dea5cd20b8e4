# Compiler settings shared by every target, and the function that makes one library a folder.

add_library(floc_settings INTERFACE)
target_compile_features(floc_settings INTERFACE cxx_std_20)
# No contraction to fused multiply-add: a run gives the same bits whatever the compiler chose to fuse.
# Square roots need not set errno and floating-point traps are unused, so loops with selects vectorise;
# neither changes a result.
target_compile_options(floc_settings INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  # With a precompiled header g++ 12 takes strings for too short where it copies them (its bugs 105329, 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread>
  # Instead of -O3, a fifth of g++'s time: but for the force loop, which has it (lib/floc/relaxation), nothing is
  # measurably slower.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:-O2>
  # Collecting its garbage is a tenth of g++'s time below this (kB of heap).
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=600000>
  # Sources compiled together (.ci/build) are headers to g++, in which it warns of what is right in a source.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>
  # What tells g++ that the rows of a loop do not overlap.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-unknown-pragmas>)
if(NOT FLOC_WARNINGS)
  target_compile_options(floc_settings INTERFACE -w)
elseif(FLOC_WARNINGS_AS_ERRORS)
  target_compile_options(floc_settings INTERFACE -Werror)
endif()
if(FLOC_NATIVE)
  target_compile_options(floc_settings INTERFACE -march=native)
endif()
if(FLOC_FUZZ)
  target_compile_options(floc_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(FLOC_HARDENED)
  target_compile_definitions(floc_settings INTERFACE _GLIBCXX_ASSERTIONS)
endif()
if(FLOC_SANITIZE)
  target_compile_options(floc_settings INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(floc_settings INTERFACE -fsanitize=address,undefined)
endif()

# floc_for_modules(TARGET...)
# Code that may end up in a shared module, such as that of Python. Hidden symbols are called, and inlined, as in a
# program: position-independent code alone would let any other library replace them.
function(floc_for_modules)
  set_target_properties(${ARGN} PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# floc_precompile(TARGET [REUSE_FROM target] [HEADERS header...])
# Headers of other projects that nearly every source reads, Eigen first, parsed once for many targets: a source costs
# two to three seconds less. Sources go on naming what they use: builds with -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON, the
# debug preset among them, see nothing of this. No header of floc's own is here: a change of one rebuilds no more than
# what includes it. HEADERS are added to the list; a target takes the file of another with the same compile options.
set(floc_common_headers
  <algorithm> <array> <cassert> <cmath> <cstdint> <functional> <limits> <map> <memory> <numbers> <numeric> <optional>
  <sstream> <string> <string_view> <utility> <variant> <vector>
  <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <Eigen/SparseCore> <fmt/format.h> <fmt/ranges.h>)
function(floc_precompile target)
  cmake_parse_arguments(ARG "" "REUSE_FROM" "HEADERS" ${ARGN})
  if(ARG_REUSE_FROM)
    target_precompile_headers(${target} REUSE_FROM ${ARG_REUSE_FROM})
  else()
    target_precompile_headers(${target} PRIVATE ${floc_common_headers} ${ARG_HEADERS})
  endif()
endfunction()

# floc_add_library(NAME [TOGETHER n] [EXCLUDE source...] [LIBS target...] [PRIVATE_LIBS target...])
# One library from all sources of the calling folder but those left out, named floc_NAME and exported as floc::NAME. Those
# that use OpenMP share one precompiled header, of the first of them; the others that of floc_base. Where .ci/build has
# sources compiled together, n at a time.
function(floc_add_library name)
  cmake_parse_arguments(ARG "" "TOGETHER" "EXCLUDE;LIBS;PRIVATE_LIBS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cc")
  foreach(excluded IN LISTS ARG_EXCLUDE)
    list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/${excluded}")
  endforeach()
  if(sources)
    add_library(floc_${name} STATIC ${sources})
    floc_for_modules(floc_${name})
    if(ARG_TOGETHER)
      set_target_properties(floc_${name} PROPERTIES UNITY_BUILD_BATCH_SIZE ${ARG_TOGETHER})
    endif()
    set(scope PUBLIC)
    set(owner floc_base)
    if("OpenMP::OpenMP_CXX" IN_LIST ARG_PRIVATE_LIBS)
      set(owner floc_linalg)
    endif()
    if("floc_${name}" STREQUAL owner)
      floc_precompile(floc_${name})
    else()
      floc_precompile(floc_${name} REUSE_FROM ${owner})
    endif()
    target_link_libraries(floc_${name} PRIVATE $<BUILD_INTERFACE:floc_settings> ${ARG_PRIVATE_LIBS})
  else()
    add_library(floc_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(floc::${name} ALIAS floc_${name})
  set_target_properties(floc_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(floc_${name} ${scope} cxx_std_20)
  target_include_directories(floc_${name} ${scope}
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(floc_${name} ${scope} ${ARG_LIBS})
  install(TARGETS floc_${name} EXPORT flocTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library)
  set_property(GLOBAL APPEND PROPERTY FLOC_LIBRARIES floc_${name})
endfunction()
