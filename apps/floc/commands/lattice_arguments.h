#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/lattice/fracture.h"
#include "floc/lattice/lattice_solution.h"
#include "process/command_line.h"
#include "process/printing.h"

namespace floc {

/// Values of the arguments and options of `floc lattice`.
struct LatticeArguments {
  std::string file;
  double matrix = 0.0;
  std::string stiffness;
  std::optional<double> per_diameter;  ///< nodes per mean grain diameter; if absent, 15 in 2D, 6.5 in 3D
  std::optional<double> spacing;
  double bridge_gap = 0.05;
  std::string contacts = "unilateral";
  std::optional<double> patch;
  double shear = 0.0;
  double bending = 0.0;
  bool by_facet = false;
  double jitter = 0.35;
  std::uint64_t seed = 1;
  std::string load = "compression";
  std::string axis;
  std::string boundary = "periodic";
  bool moduli = false;
  std::optional<double> tolerance;
  std::string compare;
  std::string output, stress, forces, pdf, plot, map, phases;
  double bin_width = 0.1;
  /// Stress at the end of the colour scale of --map, in units of the mean stress; 0 means the default, 4.
  double largest = 0.0;
  std::string cut = "y,0.5";
  double pixels = 4.0;  ///< pixels per lattice node in pictures
  std::string strength;
  double end_at = 0.2;
  std::string curve, cracks;
  bool yes = false;
  Printing printing;
};

/// Adds the arguments and options of `floc lattice` to its command line.
void add_lattice_options(CommandLine app, LatticeArguments& arguments);

/// Parses text such as "grain=100,matrix=1", a list of items NAME=NUMBER.
/// @param option  name of the option whose value is `text`, for messages
/// @param names   names that may occur in `text`
/// @return one number for each of `names`, in their order; absent if the name does not occur in `text`
/// @throws InputError if a name is not one of `names` or is given twice, or if a number is not valid
std::vector<std::optional<double>> named_numbers(const std::string& option, const std::string& text,
                                                 const std::vector<std::string>& names);

// Each of the following functions converts options to an argument of the library. If options have invalid values, the
// function throws an InputError that lists all of them.
ElementStiffness stiffness_of(const LatticeArguments& arguments);
ElementStrength strength_of(const LatticeArguments& arguments);
LatticeBoundary boundary_of(const LatticeArguments& arguments);
/// Returns whether the sample is between plates, bonded to the sample or not.
bool is_between_plates(const LatticeArguments& arguments);
int axis_of(const LatticeArguments& arguments, int dimension);

/// Returns the load that the option --load describes. Its keywords compression and tension mean a stress of magnitude 1
/// along the axis that the option --axis names.
/// @throws InputError if the load is not valid, or if plates cannot exert it
template <int Dim>
LatticeLoad<Dim> load_of(const LatticeArguments& arguments);

}  // namespace floc
