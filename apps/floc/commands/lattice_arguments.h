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

/// The command line of floc lattice.
struct LatticeArguments {
  std::string file;
  double matrix = 0.0;
  std::string stiffness;
  std::optional<double> per_diameter;  ///< nodes per mean diameter; default: 15 in 2D, 6.5 in 3D
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
  double largest = 0.0;  ///< stress at the end of the colour scale of a map; 0: four times the mean
  std::string cut = "y,0.5";
  double pixels = 4.0;  ///< pixels per node in pictures
  std::string strength;
  double end_at = 0.2;
  std::string curve, cracks;
  bool yes = false;
  Printing printing;
};

/// Adds the arguments and options of floc lattice.
void add_lattice_options(CommandLine app, LatticeArguments& arguments);

/// Parses text such as "grain=100,matrix=1". @return number given for each of `names`, in their order
/// @throws InputError naming option, name and value if a name is not in `names` or is given twice, or a number is not
/// valid
std::vector<std::optional<double>> named_numbers(const std::string& option, const std::string& text,
                                                 const std::vector<std::string>& names);

// Each converts an option to the argument of the library. @throws InputError with every fault
ElementStiffness stiffness_of(const LatticeArguments& arguments);
ElementStrength strength_of(const LatticeArguments& arguments);
LatticeBoundary boundary_of(const LatticeArguments& arguments);
int axis_of(const LatticeArguments& arguments, int dimension);

/// Returns the load; a uniaxial one has a stress of 1.
template <int Dim>
LatticeLoad<Dim> load_of(const LatticeArguments& arguments);

}  // namespace floc
