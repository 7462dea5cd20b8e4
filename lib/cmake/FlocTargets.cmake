# Compiler settings shared by every target, and the function that makes one library a folder.

add_library(floc_settings INTERFACE)
target_compile_features(floc_settings INTERFACE cxx_std_20)
# No contraction to fused multiply-add: a run gives the same bits whatever the compiler chose to fuse.
# Square roots need not set errno and floating-point traps are unused, so loops with selects vectorise;
# neither changes a result.
target_compile_options(floc_settings INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(FLOC_WARNINGS_AS_ERRORS)
  target_compile_options(floc_settings INTERFACE -Werror)
endif()
if(FLOC_NATIVE)
  target_compile_options(floc_settings INTERFACE -march=native)
endif()
if(FLOC_FUZZ)
  target_compile_options(floc_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(FLOC_SANITIZE)
  target_compile_options(floc_settings INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(floc_settings INTERFACE -fsanitize=address,undefined)
endif()

# floc_add_library(NAME [LIBS target...] [PRIVATE_LIBS target...])
# One library from all sources of the calling folder, named floc_NAME and exported as floc::NAME.
function(floc_add_library name)
  cmake_parse_arguments(ARG "" "" "LIBS;PRIVATE_LIBS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cc")
  if(sources)
    add_library(floc_${name} STATIC ${sources})
    set(scope PUBLIC)
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
  install(TARGETS floc_${name} EXPORT flocTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  set_property(GLOBAL APPEND PROPERTY FLOC_LIBRARIES floc_${name})
endfunction()
