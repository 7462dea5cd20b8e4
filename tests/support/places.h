#pragma once

#include <string>

/// Where what the tests read and run lies. Not on the compile lines, nor in what many sources include: a
/// compiler cache then serves all checkouts.
namespace floc::test {

/// The checkout, without a slash at the end.
std::string source_directory();

/// A packing of 16 frictionless disks in the format of jamBashbulk.
std::string jambashbulk_file();

/// The tables of the runs of data/scenes/demo.toml.
std::string demo_tables();

/// The program floc as built beside the tests.
std::string floc_program();

/// The library with the kernels of the relaxer.
std::string relaxation_library();

}  // namespace floc::test
