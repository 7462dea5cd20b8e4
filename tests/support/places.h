#pragma once

#include <string>

/// Paths of the files that tests read and run. A single source file contains the paths. If they were compiler options
/// or part of this header, several checkouts could not share a compiler cache.
namespace floc::test {

/// Root of the source tree, without a slash at the end.
std::string source_directory();

/// Path of a packing of 16 frictionless disks in the format of jamBashbulk.
std::string jambashbulk_file();

/// Directory of the tables of the runs of data/scenes/demo.toml.
std::string demo_tables();

/// Path of the program floc that was built with the tests.
std::string floc_program();

/// Path of the library that contains the kernels of the relaxation.
std::string relaxation_library();

/// Path of the library that contains the kernels of the sweeps over rigid contacts.
std::string rigid_library();

}  // namespace floc::test
