# cpack: packages for Debian. Without PETSc or Python there is no package of them.
set(floc_packages program library)
if(FLOC_PETSC)
  list(APPEND floc_packages petsc)
endif()
if(TARGET floc_python)
  list(APPEND floc_packages python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME floc)
set(CPACK_PACKAGE_CONTACT "The floc developers <floc@lists.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "static equilibria of granular packings")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${floc_packages})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

# floc_package(COMPONENT NAME DESCRIPTION [DEPENDS text] [RECOMMENDS text] [SUGGESTS text] [SECTION section])
# DESCRIPTION is one line for each line of the package's.
macro(floc_package component name description)
  cmake_parse_arguments(ARG "" "DEPENDS;RECOMMENDS;SUGGESTS;SECTION" "" ${ARGN})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${description}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${ARG_DEPENDS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS "${ARG_RECOMMENDS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SUGGESTS "${ARG_SUGGESTS}")
  if(ARG_SECTION)
    set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${ARG_SECTION})
  endif()
  install(FILES lib/cmake/debian/copyright DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name}"
    COMPONENT ${component})
  install(FILES "${floc_changelog}" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name}" COMPONENT ${component})
endmacro()

set(floc_changelog "${PROJECT_BINARY_DIR}/changelog.gz")
add_custom_command(OUTPUT "${floc_changelog}" DEPENDS lib/cmake/debian/changelog
  COMMAND gzip -9nc "${PROJECT_SOURCE_DIR}/lib/cmake/debian/changelog" > "${floc_changelog}" VERBATIM)
add_custom_target(floc_changelog ALL DEPENDS "${floc_changelog}")

floc_package(program floc
  "floc makes and analyses static packings of disks and spheres: powders, fine
soils and granular aggregates, with or without cohesion. It loads them along a
path of pressures or strains with a verified mechanical equilibrium at every
step, and computes elastic moduli of any saved packing between rigorous bounds,
force networks, and the consolidation law that the packing follows."
  RECOMMENDS "gnuplot-nox | gnuplot" SUGGESTS "floc-petsc, python3-floc, snakemake")
floc_package(library libfloc-dev
  "This package has the static C++ libraries of floc, their headers, and what
CMake needs to find them: find_package(floc)."
  SECTION libdevel
  DEPENDS "libeigen3-dev, libspectra-dev, libsuitesparse-dev, libopenblas-dev, libceres-dev, libtomlplusplus-dev, nlohmann-json3-dev, libfmt-dev, libspdlog-dev, libhdf5-dev, libpugixml-dev, zlib1g-dev, libfftw3-dev, voro++-dev, libcairo2-dev, pkg-config, libgomp1")
if(FLOC_PETSC)
  floc_package(petsc floc-petsc
    "With this package the option --solver petsc of floc moduli solves for the
moduli of large packings by PETSc, on several processes under MPI."
    DEPENDS "floc (= ${PROJECT_VERSION}), openmpi-bin")
endif()
if(TARGET floc_python)
  math(EXPR floc_next_python "${Python_VERSION_MINOR} + 1")
  floc_package(python python3-floc
    "This package has the Python module floc: states as numpy arrays, moduli,
networks, structure, fits, runs of scenes, and packings from arrays."
    SECTION python RECOMMENDS "python3-matplotlib" SUGGESTS "floc"
    DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${floc_next_python}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/lib/cmake/debian/postinst;${PROJECT_SOURCE_DIR}/lib/cmake/debian/prerm")
endif()
include(CPack)
