# Debian's SuiteSparse 5 ships no CMake package: find CHOLMOD, UMFPACK, SuiteSparseQR and the OpenBLAS they run on.
# OpenBLAS is linked by name and before everything else, needed by the program itself or not: the first definition of a
# BLAS routine serves all libraries, and Ceres brings ATLAS along, which is 2.6 times slower inside CHOLMOD.
find_path(SparseSolvers_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(SparseSolvers_CONFIG_LIBRARY suitesparseconfig)
find_library(SparseSolvers_CHOLMOD_LIBRARY cholmod)
find_library(SparseSolvers_UMFPACK_LIBRARY umfpack)
find_library(SparseSolvers_SPQR_LIBRARY spqr)
find_library(SparseSolvers_OpenBLAS_LIBRARY openblas)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SparseSolvers REQUIRED_VARS
  SparseSolvers_INCLUDE_DIR SparseSolvers_CONFIG_LIBRARY SparseSolvers_CHOLMOD_LIBRARY
  SparseSolvers_UMFPACK_LIBRARY
  SparseSolvers_SPQR_LIBRARY SparseSolvers_OpenBLAS_LIBRARY)
if(SparseSolvers_FOUND AND NOT TARGET SparseSolvers::SparseSolvers)
  add_library(SparseSolvers::SparseSolvers INTERFACE IMPORTED)
  set_target_properties(SparseSolvers::SparseSolvers PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${SparseSolvers_INCLUDE_DIR}"
    INTERFACE_LINK_OPTIONS
      "LINKER:--push-state,--no-as-needed;${SparseSolvers_OpenBLAS_LIBRARY};LINKER:--pop-state"
    INTERFACE_LINK_LIBRARIES
      "${SparseSolvers_SPQR_LIBRARY};${SparseSolvers_CHOLMOD_LIBRARY};${SparseSolvers_UMFPACK_LIBRARY};${SparseSolvers_CONFIG_LIBRARY};${SparseSolvers_OpenBLAS_LIBRARY}")
endif()
mark_as_advanced(SparseSolvers_INCLUDE_DIR SparseSolvers_CONFIG_LIBRARY SparseSolvers_CHOLMOD_LIBRARY
  SparseSolvers_UMFPACK_LIBRARY
  SparseSolvers_SPQR_LIBRARY SparseSolvers_OpenBLAS_LIBRARY)
