#include "floc/scene/read_saved_start.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/io/law_text.h"
#include "floc/io/state_file.h"
#include "floc/packing/bonds.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Reads the packing from which a run starts. This function is called at the beginning of the run; the state file has
/// been read before, together with the scene.
/// @param sha256  SHA-256 checksum that the file had when the scene was read
/// @throws InputError if the file has changed since then
std::variant<Packing<2>, Packing<3>> read_again(const std::string& file, const std::string& sha256) {
  if (sha256_of_file(file) != sha256)
    throw InputError(
        file, "the file has changed since the scene was read: restore the state from which the scene starts");
  return std::visit([](auto state) -> std::variant<Packing<2>, Packing<3>> { return std::move(state.packing); },
                    read_state(file));
}

/// Returns the number of copies of the saved packing along each axis, from the key assembly.copies. In 2D the number
/// along the third axis is 1.
Vec<3, int> read_copies(TableReader& t, int dimension) {
  const bool plane = dimension == 2;
  const char* example = plane
                            ? "the numbers of copies along the two axes, two whole numbers, e.g. [10, 10]"
                            : "the numbers of copies along the three axes, three whole numbers, e.g. [2, 2, 2]";
  const std::vector<double> copies =
      t.numbers("copies", {[](double n) { return n >= 1 && n <= kMaxGrains && n == std::floor(n); }, example});
  Vec<3, int> out = Vec<3, int>::Ones();
  if (copies.size() == static_cast<std::size_t>(dimension)) {
    for (int a = 0; a < dimension; ++a) out[a] = static_cast<int>(copies[a]);
  } else if (!copies.empty()) {
    t.fault("copies", fmt::format("assembly.copies has {} numbers: expected {}", copies.size(),
                                  plane ? "two, e.g. [10, 10]" : "three, e.g. [2, 2, 2]"));
  }
  return out;
}

/// Returns the reason why a run of the scene cannot start from a saved state; empty if it can.
template <int Dim>
std::string refusal_of(const State<Dim>& state, const Scene& scene) {
  if (Dim != scene.dimension)
    return fmt::format("the state has dimension {}: expected a state of {}, like the scene", Dim,
                       scene.dimension == 2 ? "disks" : "spheres");
  if (state.units != scene.units)
    return fmt::format("the units of the state are \"{}\": expected the units of the scene, \"{}\"",
                       state.units, scene.units);
  // An open end is stored as a wall (Wall::open), so the test of walls below would refuse this state, too. This test
  // comes first, because its message names the free space.
  if (is_open(state.packing.walls) && !scene.assembly.box)
    return "the state ends in free space along an axis: expected a periodic state, or a table [box] in "
           "the "
           "scene";
  if (has_bonds(state.packing))
    return "the state has bonds (contacts/bonded), which a run cannot keep: expected a state without bonds";
  const bool has_walls = !state.packing.walls.empty();
  if (has_walls != scene.assembly.box.has_value())
    return has_walls ? "the state has walls: expected a table [box] in the scene"
                     : "the state has no walls: expected a table [cell] in the scene";
  const Cell<Dim>& cell = state.packing.cell;
  // The elements above the diagonal must be exactly zero, because the static solver requires a lower triangular matrix.
  // A diagonal element that is not positive would mean a reversed lattice vector or a cell without volume.
  if (!cell.matrix.isLowerTriangular(0.0) || cell.matrix.diagonal().minCoeff() <= 0.0)
    return "the cell of the state (cell/matrix) is rotated: expected a first lattice vector along the first "
           "axis and a second lattice vector in the plane of the first two axes, so that the sides of the cell "
           "can follow the load";
  if (scene.law.is_rigid() && !cell.rectangular())
    return "the cell of the state (cell/matrix) is skewed: rigid grains need a rectangular cell in this "
           "version of floc";
  return "";
}

/// Describes the grains of a saved packing in the form in which a scene describes grains: number, sizes, and density.
/// The density is computed from the heaviest grain.
/// @param n_tiles  number of copies of the saved packing in the first packing of the run
template <int Dim>
GrainOptions grains_of(const Grains<Dim>& grains, int n_tiles) {
  GrainOptions out;
  out.count = n_tiles * grains.size();
  out.diameter.kind = DiameterDistribution::Kind::list;
  const auto [smallest, largest] = std::minmax_element(grains.radius.begin(), grains.radius.end());
  out.diameter.min = 2.0 * *smallest;
  out.diameter.max = 2.0 * *largest;
  const auto heaviest = std::max_element(grains.mass.begin(), grains.mass.end()) - grains.mass.begin();
  const double radius = grains.radius[static_cast<std::size_t>(heaviest)];
  const double ball =
      Dim == 2 ? std::numbers::pi * radius * radius : 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  const double volume = grains.are_round() ? ball : grains.volume(static_cast<int>(heaviest));
  out.density = grains.mass[static_cast<std::size_t>(heaviest)] / volume;
  return out;
}

template <int Dim>
std::string start_description(const State<Dim>& state, const std::string& file, const Scene& scene) {
  const Law& law = state.packing.law;
  const Vec<Dim, int> copies = scene.assembly.saved.copies_along<Dim>();
  return fmt::format(
      "{}, {} grains at the solid fraction {:.6g} under the pressure {:.4g}, {} copies; contact law {}", file,
      state.packing.grains.size(), scene.assembly.solid_fraction, state.target_stress.mean(),
      fmt::join(copies.begin(), copies.end(), " x "),
      law == scene.law ? "as in the state file"
                       : "of the scene, in place of the contact law in the state file: " + law_text(law));
}

/// Sets the stresses at the beginning of the run to the stresses of the saved state, if the scene gives no pressure.
/// @param has_pressure  whether the scene gives a pressure
template <int Dim>
void keep_stress(TableReader& t, const State<Dim>& state, bool has_pressure, Scene& scene) {
  if (has_pressure || scene.assembly.box) return;
  const Vec<Dim>& stress = state.target_stress;
  if (!(stress.mean() > 0.0))
    return t.fault("pressure",
                   fmt::format("assembly.pressure is missing: expected a positive number (first pressure of "
                               "the packing), because the mean stress of the state is {:g}",
                               stress.mean()));
  scene.assembly.pressure = stress.mean();
  if (stress.isConstant(stress.mean())) return;
  if (scene.law.is_rigid())
    return t.fault("pressure",
                   "assembly.pressure is missing: expected a positive number (first pressure of the packing), "
                   "because the stresses of the state differ between its axes, and rigid grains cannot keep "
                   "different stresses in this version of floc");
  scene.assembly.saved.kept =
      KeptStress{{stress.begin(), stress.end()}, state.path.turn.empty() ? Dim - 1 : state.path.turn.axis};
}

/// Completes a scene that starts from a saved state: sets the grains, the solid fraction, and a text that describes the
/// start.
/// @param file  name of the state file
template <int Dim>
void describe_start(TableReader& t, const State<Dim>& state, const std::string& file, Scene& scene) {
  SavedStart& start = scene.assembly.saved;
  const double n_grains = start.copies.cast<double>().prod() * state.packing.grains.size();
  if (n_grains < 2 || n_grains > kMaxGrains) {
    start.copies.setOnes();
    t.fault("copies",
            fmt::format("assembly.copies: all copies together have {:g} grains, expected 2 to 1e8 grains",
                        n_grains));
  }
  if (scene.assembly.box && start.copies.prod() != 1)
    t.fault("copies",
            "assembly.copies: a packing between walls cannot be repeated; expected one copy along each axis");
  scene.grains = grains_of(state.packing.grains, start.copies.prod());
  start.has_shapes = !state.packing.grains.are_round();
  scene.assembly.solid_fraction = solid_fraction(state.packing);
  scene.start = start_description(state, file, scene);
}

}  // namespace

void read_saved_start(TableReader& t, const std::string& directory, Scene& scene) {
  const auto name = t.text("state", "the name of a state file");
  const auto expected =
      t.text("state_sha256", "the SHA-256 of the state file, which floc writes", Need::optional);
  SavedStart& start = scene.assembly.saved;
  start.copies = read_copies(t, scene.dimension);
  // A placeholder is stored as the pressure. If the state cannot be read, later checks then do not report a missing
  // stress in addition.
  const bool has_pressure = t.has("pressure");
  if (!has_pressure && !scene.assembly.box) scene.assembly.pressure = 1.0;
  if (!name) return;
  const std::string file = (std::filesystem::path(directory) / *name).string();
  try {
    const AnyState any = read_state(file);
    start.sha256 = sha256_of_file(file);
    const std::string failure_reason =
        std::visit([&](const auto& state) { return refusal_of(state, scene); }, any);
    if (!failure_reason.empty())
      return t.fault("state", fmt::format("assembly.state: {}: {}", file, failure_reason));
    if (expected && *expected != start.sha256)
      t.fault("state_sha256", fmt::format("assembly.state_sha256 = {}: the file {} has the SHA-256 {}; "
                                          "expected the file with the given SHA-256, or remove the key",
                                          *expected, file, start.sha256));
    std::visit(
        [&](const auto& state) {
          describe_start(t, state, file, scene);
          keep_stress(t, state, has_pressure, scene);
        },
        any);
    start.read = [file, sha256 = start.sha256] { return read_again(file, sha256); };
  } catch (const InputError& error) {
    t.fault("state", fmt::format("assembly.state: {}", error.what()));
  }
}

}  // namespace floc
