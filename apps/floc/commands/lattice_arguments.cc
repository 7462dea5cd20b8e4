#include "commands/lattice_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/lattice/cemented_sample.h"
#include "floc/picture/lattice_picture.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

const std::vector<std::string> kBondKinds = {"grain", "matrix", "interface", "contact"};

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

void refuse_faults(const std::string& option, const std::vector<std::string>& faults) {
  if (!faults.empty()) throw InputError(option, fmt::format("{}", fmt::join(faults, "; ")));
}

}  // namespace

void add_lattice_options(CommandLine app, LatticeArguments& a) {
  app.add_option("STATE", a.file, "state file of the grains, or - for a state on stdin").required();
  app.add_option("--matrix", a.matrix, "volume fraction of the matrix, the solid between the grains")
      .required()
      .within(CementOptions::kContent);
  app.add_option(
      "--stiffness", a.stiffness,
      "grain=K,matrix=K,interface=K,contact=K: stiffness of the elements inside grains, inside the matrix, "
      "between a grain and the matrix, and between two grains (force/length) [grain and matrix: 1; "
      "interface: 2 K K'/(K + K'), where K is the stiffness of the grains and K' that of the matrix; contact: "
      "the value for grain]");
  // Some defaults differ between 2D and 3D. They are set after the state has been read, so the variables of these
  // options are still empty here.
  app.add_option("--per-diameter", a.per_diameter,
                 "number of lattice nodes per mean grain diameter [15 in 2D, 6.5 in 3D]")
      .positive();
  app.add_option("--spacing", a.spacing,
                 "distance between neighbouring lattice nodes, instead of --per-diameter (length)")
      .positive()
      .excludes("--per-diameter");
  app.add_option("--bridge-gap", a.bridge_gap,
                 "largest gap between two grains across which a bridge of matrix connects them, in mean "
                 "diameters [0.05]")
      .non_negative();
  app.add_option("--contacts", a.contacts,
                 "elements between two grains without matrix between them (bare contacts): unilateral "
                 "(compression only), bilateral (also tension) or none (no force) [unilateral]")
      .one_of({"unilateral", "bilateral", "none"});
  app.add_option("--patch", a.patch,
                 "half width of bare contacts, in units of 2 R1 R2/(R1 + R2) with the radii R1 and R2 of the "
                 "two grains: "
                 "elements of a contact that are farther from the line between the centres of the grains "
                 "are left out [no limit]")
      .non_negative();
  app.add_option(
         "--shear", a.shear,
         "ratio K_T/K_N of the tangential to the normal stiffness of the elements [0, so that the elements are "
         "central springs]")
      .non_negative();
  app.add_option("--bending", a.bending,
                 "bending stiffness K_R of the elements, given as the ratio K_R/(K_N h^2) with their normal "
                 "stiffness K_N and the spacing h of the nodes [0]")
      .non_negative();
  app.add_flag(
      "--by-facet", a.by_facet,
      "take the values of --stiffness as moduli E (stress); the stiffness of an element is then E A/L, with "
      "the length L of the element and the area A of the facet between its two nodes");
  app.add_option(
      "--jitter", a.jitter,
      "in 3D, largest random displacement of a node from a regular lattice, in units of the spacing [0.35]");
  app.add_option("--seed", a.seed, "in 3D, seed of the random displacements of the nodes [1]");
  app.add_option(
      "--load", a.load,
      "load on the sample: compression or tension (a stress of magnitude 1 along the axis of --axis), or "
      "stress:S11,S22,... or strain:E11,E22,... with the components in the order 11,22,12 (2D) or "
      "11,22,33,23,13,12 (3D) [compression]");
  app.add_option("--axis", a.axis, "axis of the load: x, y or z [the last one]").one_of({"x", "y", "z"});
  app.add_option(
         "--boundary", a.boundary,
         "boundary of the sample: periodic, plates (two frictionless plates perpendicular to the axis, other "
         "sides "
         "free), bonded-plates (plates to which the sample sticks), or uniform-strain (all nodes at the "
         "border move with a uniform strain) [periodic]")
      .one_of({"periodic", "plates", "bonded-plates", "uniform-strain"});
  app.add_flag("--moduli", a.moduli,
               "compute all elastic moduli of the loaded sample, and bounds of its bulk and shear modulus");
  app.add_option("--tolerance", a.tolerance,
                 "largest imbalance of the forces on the nodes in the solution, relative to the load [1e-10 in "
                 "2D, 1e-9 in 3D]")
      .within(RelaxationSettings::kTolerance);
  app.add_option(
      "--compare", a.compare,
      "state file with the same grains, whose contact forces are compared with those of the lattice");
  app.add_option(
      "-o,--output", a.output,
      "state file to write: the loaded lattice, with its nodes as grains and its elements as contacts");
  app.add_option("--stress", a.stress, "csv file to write, with one row per node: phase, position and stress");
  app.add_option("--forces", a.forces,
                 "state file to write: the grains, with the forces between them as contact forces");
  app.add_option(
      "--pdf", a.pdf,
      "csv file to write: distributions of the stresses of the nodes and of the forces between grains");
  app.add_option(
         "--bin-width", a.bin_width,
         "bin width of the distributions of --pdf and --plot, in units of the mean stress or force [0.1]")
      .positive();
  app.add_option(
      "--plot", a.plot,
      "plot to write (F.svg, F.pdf or F.png): distributions of the stress, with fitted exponential tails");
  app.add_option("--map", a.map,
                 "picture to write (F.svg, F.pdf or F.png): normal stress of the nodes along the axis of the "
                 "load, in colour");
  app.add_option("--largest", a.largest,
                 "largest stress of the colour scale of --map, in units of the mean stress [4]")
      .positive();
  app.add_option("--phases", a.phases, "picture to write (F.svg, F.pdf or F.png): grains, matrix and voids");
  app.add_option(
      "--cut", a.cut,
      "AXIS,FRACTION: in 3D, section through the sample that the pictures show; AXIS is perpendicular to the "
      "section, and FRACTION is the position of the section along AXIS, as a fraction of the cell [y,0.5]");
  app.add_option("--pixels", a.pixels,
                 "number of pixels per lattice node in pictures; fewer if a side of the picture would exceed "
                 "3000 pixels [4]")
      .within(LatticeSheetOptions::kPixels);
  // With --strength, floc lattice also breaks the sample. The following options apply only to this breaking.
  app.add_option(
      "--strength", a.strength,
      "grain=F,matrix=F,interface=F,contact=F: break the sample, one element at a time; F is the tension at "
      "which an element of this kind breaks (force), and kinds that are not named never break");
  app.add_option("--end-at", a.end_at,
                 "the breaking ends when the stress has fallen below this fraction of the largest stress [0.2]")
      .within(FractureOptions::kShare);
  app.add_option("--curve", a.curve,
                 "csv file to write, with one row per broken element: strain, stress and the element");
  app.add_option("--cracks", a.cracks,
                 "picture to write (F.svg, F.pdf or F.png): the broken elements in the sample");
  app.add_flag("--yes", a.yes, "also break samples of more than 20000 nodes, which can take long");
  add_printing_options(app, a.printing);
}

std::vector<std::optional<double>> named_numbers(const std::string& option, const std::string& text,
                                                 const std::vector<std::string>& names) {
  std::vector<std::optional<double>> numbers(names.size());
  if (text.empty()) return numbers;
  for (const std::string& part : parts_of(text)) {
    const std::size_t equals = part.find('=');
    const auto name = std::find(names.begin(), names.end(), part.substr(0, equals));
    if (equals == std::string::npos || name == names.end())
      throw InputError(option, fmt::format("'{}' is not valid: expected NAME=NUMBER, where NAME is one of {}",
                                           part, fmt::join(names, ", ")));
    std::optional<double>& number = numbers[static_cast<std::size_t>(name - names.begin())];
    if (number)
      throw InputError(option, fmt::format("'{}' is not valid: a number for {} is given twice", part, *name));
    number = parse_number<double>(std::string_view(part).substr(equals + 1));
    if (!number)
      throw InputError(option, fmt::format("'{}' is not valid: expected a number after the sign =", part));
  }
  return numbers;
}

ElementStiffness stiffness_of(const LatticeArguments& a) {
  ElementStiffness out;
  const auto numbers = named_numbers("--stiffness", a.stiffness, kBondKinds);
  out.grain = numbers[0].value_or(1.0);
  out.matrix = numbers[1].value_or(1.0);
  out.interface = numbers[2];
  out.bare = numbers[3];
  out.shear = a.shear;
  out.bending = a.bending;
  out.by_facet = a.by_facet;
  out.patch = a.patch;
  out.contact = a.contacts == "none"        ? BareContact::none
                : a.contacts == "bilateral" ? BareContact::bilateral
                                            : BareContact::unilateral;
  refuse_faults("floc lattice", out.validate());
  return out;
}

ElementStrength strength_of(const LatticeArguments& a) {
  ElementStrength out;
  const auto numbers = named_numbers("--strength", a.strength, kBondKinds);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    out.tension[k] = numbers[k].value_or(std::numeric_limits<double>::infinity());
  refuse_faults("--strength", out.validate());
  return out;
}

LatticeBoundary boundary_of(const LatticeArguments& a) {
  static const std::map<std::string, LatticeBoundary> kBoundaries = {
      {"periodic", LatticeBoundary::periodic},
      {"plates", LatticeBoundary::plates},
      {"bonded-plates", LatticeBoundary::bonded_plates},
      {"uniform-strain", LatticeBoundary::uniform_strain}};
  return kBoundaries.at(a.boundary);
}

bool is_between_plates(const LatticeArguments& a) {
  const LatticeBoundary boundary = boundary_of(a);
  return boundary == LatticeBoundary::plates || boundary == LatticeBoundary::bonded_plates;
}

int axis_of(const LatticeArguments& a, int dimension) {
  if (a.axis.empty()) return dimension - 1;
  const int axis = a.axis[0] - 'x';
  if (axis >= dimension)
    throw InputError("--axis " + a.axis, "the state is two-dimensional and has no axis z: expected x or y");
  return axis;
}

template <int Dim>
LatticeLoad<Dim> load_of(const LatticeArguments& a) {
  const int axis = axis_of(a, Dim);
  if (a.load == "compression" || a.load == "tension")
    return LatticeLoad<Dim>::uniaxial(axis, a.load == "tension" ? -1.0 : 1.0);
  const std::size_t colon = a.load.find(':');
  const std::string kind = a.load.substr(0, colon);
  const std::string expected = fmt::format(
      "this is not a load: expected compression, tension, stress:S11,S22,... or strain:E11,E22,... with {} "
      "numbers separated by commas",
      kSymmetric<Dim>);
  if (colon == std::string::npos || (kind != "stress" && kind != "strain"))
    throw InputError("--load " + a.load, expected);
  const std::vector<std::string> parts = parts_of(a.load.substr(colon + 1));
  LatticeLoad<Dim> load;
  load.imposed.setConstant(kind == "strain");
  if (parts.size() != kSymmetric<Dim>) throw InputError("--load " + a.load, expected);
  for (int k = 0; k < kSymmetric<Dim>; ++k) {
    const auto number = parse_number<double>(parts[k]);
    if (!number) throw InputError("--load " + a.load, expected);
    // Squares of the components and their products with stiffnesses must neither overflow nor vanish.
    constexpr NumberRange kSizes = ElementStiffness::kRange;
    if (*number != 0.0 && !kSizes.holds(std::abs(*number)))
      throw InputError("--load " + a.load,
                       fmt::format("component {}: expected 0 or a number whose magnitude is from {} to {}",
                                   parts[k], kSizes.least, kSizes.most));
    load.value[k] = *number;
  }
  if (load.value.isZero(0.0))
    throw InputError("--load " + a.load,
                     "all components of this load are zero: expected at least one number other than zero");
  if (is_between_plates(a))
    for (int k = 0; k < kSymmetric<Dim>; ++k)
      if (k != axis && load.value[k] != 0.0)
        throw InputError(
            "--load " + a.load,
            fmt::format("plates load the sample only along their axis, {}: expected zero for all other "
                        "components of the load with --boundary {}",
                        static_cast<char>('x' + axis), a.boundary));
  return load;
}

template LatticeLoad<2> load_of(const LatticeArguments&);
template LatticeLoad<3> load_of(const LatticeArguments&);

}  // namespace floc
