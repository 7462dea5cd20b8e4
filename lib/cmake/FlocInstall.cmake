# cmake --install: the program with the shipped scenes and tables, man pages and completion; the libraries with their
# headers and find_package(floc). Components are the packages of FlocPackages.cmake.
include(CMakePackageConfigHelpers)

get_property(floc_libraries GLOBAL PROPERTY FLOC_LIBRARIES)
add_library(floc_all INTERFACE)
set_target_properties(floc_all PROPERTIES EXPORT_NAME floc)
target_link_libraries(floc_all INTERFACE ${floc_libraries})
install(TARGETS floc_all EXPORT flocTargets)
install(DIRECTORY lib/floc/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/floc" COMPONENT library
  FILES_MATCHING PATTERN "*.h")
set(floc_cmake_dir "${CMAKE_INSTALL_LIBDIR}/cmake/floc")
configure_package_config_file(lib/cmake/flocConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/flocConfig.cmake"
  INSTALL_DESTINATION "${floc_cmake_dir}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/flocConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(EXPORT flocTargets NAMESPACE floc:: DESTINATION "${floc_cmake_dir}" COMPONENT library)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/flocConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/flocConfigVersion.cmake"
              lib/cmake/FindSparseSolvers.cmake lib/cmake/FindVoro.cmake
  DESTINATION "${floc_cmake_dir}" COMPONENT library)

install(TARGETS floc DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
foreach(folder IN ITEMS campaigns packings scenes tables)
  install(DIRECTORY data/${folder} DESTINATION "${CMAKE_INSTALL_DATADIR}/floc" COMPONENT program)
endforeach()
# Man pages and completion for bash and zsh, from the program's own help.
install(CODE "
  set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
  message(STATUS \"Writing man pages and completion below \${share}\")
  execute_process(COMMAND python3 \"${PROJECT_SOURCE_DIR}/docs/write-help\" --floc \"$<TARGET_FILE:floc>\" \"\${share}\"
                  RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(WARNING \"no man pages and no completion: docs/write-help failed (\${status})\")
  endif()" COMPONENT program)
