#include "commands/lattice_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
  app.add_option("STATE", a.file, "state file of the grains, - for one on stdin").required();
  app.add_option("--matrix", a.matrix, "content of the matrix: its share of the volume")
      .required()
      .within(CementOptions::kContent);
  app.add_option("--stiffness", a.stiffness,
                 "grain=K,matrix=K,interface=K,contact=K: stiffnesses of the elements, force/length [1; "
                 "interface 2 K K'/(K + K'), contact that of the grains]");
  // Defaults that differ between 2D and 3D are set where the dimension of STATE is known; here the variables stay
  // empty.
  app.add_option("--per-diameter", a.per_diameter, "nodes per mean diameter [15 in 2D, 6.5 in 3D]").positive();
  app.add_option("--spacing", a.spacing, "spacing of the nodes instead (length)")
      .positive()
      .excludes("--per-diameter");
  app.add_option("--bridge-gap", a.bridge_gap, "widest gap that a bridge joins, in mean diameters [0.05]")
      .non_negative();
  app.add_option("--contacts", a.contacts,
                 "bare contacts between two grains: unilateral, bilateral or none [unilateral]")
      .one_of({"unilateral", "bilateral", "none"});
  app.add_option("--patch", a.patch,
                 "half width of bare contacts over R' = 2 R R'/(R + R') [as wide as the lattice makes them]")
      .non_negative();
  app.add_option("--shear", a.shear, "K_T/K_N of the elements [0: central springs]").non_negative();
  app.add_option("--bending", a.bending, "K_R/(K_N spacing^2) of the elements [0]").non_negative();
  app.add_flag("--by-facet", a.by_facet, "K = E facet/length: the stiffnesses are moduli");
  app.add_option("--jitter", a.jitter, "3D: largest random displacement of a node, in spacings [0.35]");
  app.add_option("--seed", a.seed, "3D: seed of these displacements [1]");
  app.add_option(
      "--load", a.load,
      "compression or tension (a stress of 1 along the axis), stress:S11,S22,... or strain:E11,E22,... in the "
      "order 11,22,12 or 11,22,33,23,13,12 [compression]");
  app.add_option("--axis", a.axis, "axis of the load: x, y or z [the last]").one_of({"x", "y", "z"});
  app.add_option("--boundary", a.boundary,
                 "periodic, plates (without friction, sides free), bonded-plates, or uniform-strain (held at "
                 "the border) "
                 "[periodic]")
      .one_of({"periodic", "plates", "bonded-plates", "uniform-strain"});
  app.add_flag("--moduli", a.moduli, "all elastic moduli about the loaded sample, and their bounds");
  app.add_option("--tolerance", a.tolerance, "relative tolerance of the solution [1e-10 in 2D, 1e-9 in 3D]")
      .positive();
  app.add_option("--compare", a.compare,
                 "state of the same grains, whose forces are compared with those of the lattice");
  app.add_option("-o,--output", a.output,
                 "file for the loaded lattice as a state: its nodes are grains, its elements contacts");
  app.add_option("--stress", a.stress, "csv: phase, position and stress of each node");
  app.add_option("--forces", a.forces, "file for the grains, with the forces between them, as a state");
  app.add_option("--pdf", a.pdf, "csv: distributions of the stress of nodes and of the forces between grains");
  app.add_option("--bin-width", a.bin_width, "bin width of these distributions, in means [0.1]").positive();
  app.add_option("--plot", a.plot, "F.svg, F.pdf or F.png: distributions of the stress with their tails");
  app.add_option("--map", a.map, "F.svg, F.pdf or F.png: the stress of the nodes along the axis");
  app.add_option("--largest", a.largest, "stress at the end of the colour scale of --map, in means [4]")
      .positive();
  app.add_option("--phases", a.phases, "F.svg, F.pdf or F.png: grains, matrix and voids");
  app.add_option("--cut", a.cut, "3D: section that the pictures show: an axis and a share of the cell [y,0.5]");
  app.add_option("--pixels", a.pixels, "pixels per node in pictures, which stay below 3000 pixels per side [4]")
      .within(LatticeSheetOptions::kPixels);
  // Giving a strength makes the command break the sample; the options below apply to breaking alone.
  app.add_option("--strength", a.strength,
                 "grain=F,matrix=F,interface=F,contact=F: tension at which elements break; a kind left out "
                 "never breaks. The sample is then broken, element by element");
  app.add_option("--end-at", a.end_at,
                 "stop breaking where the stress has fallen to this share of the largest [0.2]")
      .within(FractureOptions::kShare);
  app.add_option("--curve", a.curve, "csv: strain, stress and element of each breakage");
  app.add_option("--cracks", a.cracks, "F.svg, F.pdf or F.png: the broken elements");
  app.add_flag("--yes", a.yes, "break samples of more than 20000 nodes, however long it takes");
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
      throw InputError(
          option, fmt::format("'{}': expected NAME=NUMBER with a name of {}", part, fmt::join(names, ", ")));
    std::optional<double>& number = numbers[static_cast<std::size_t>(name - names.begin())];
    if (number) throw InputError(option, fmt::format("'{}': {} is given twice", part, *name));
    number = parse_number<double>(std::string_view(part).substr(equals + 1));
    if (!number) throw InputError(option, fmt::format("'{}': expected a number after =", part));
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

int axis_of(const LatticeArguments& a, int dimension) {
  if (a.axis.empty()) return dimension - 1;
  const int axis = a.axis[0] - 'x';
  if (axis >= dimension) throw InputError("--axis " + a.axis, "the state is of disks: expected x or y");
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
      "expected compression, tension, or stress: or strain: with {} numbers between commas", kSymmetric<Dim>);
  if (colon == std::string::npos || (kind != "stress" && kind != "strain"))
    throw InputError("--load " + a.load, expected);
  const std::vector<std::string> parts = parts_of(a.load.substr(colon + 1));
  LatticeLoad<Dim> load;
  load.imposed.setConstant(kind == "strain");
  if (parts.size() != kSymmetric<Dim>) throw InputError("--load " + a.load, expected);
  for (int k = 0; k < kSymmetric<Dim>; ++k) {
    const auto number = parse_number<double>(parts[k]);
    if (!number) throw InputError("--load " + a.load, expected);
    load.value[k] = *number;
  }
  if (load.value.isZero(0.0))
    throw InputError("--load " + a.load, "is not a load: expected at least one number other than zero");
  return load;
}

template LatticeLoad<2> load_of(const LatticeArguments&);
template LatticeLoad<3> load_of(const LatticeArguments&);

}  // namespace floc
