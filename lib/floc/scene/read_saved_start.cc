#include "floc/scene/read_saved_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/io/law_text.h"
#include "floc/io/state_file.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// The packing of a file that was looked at before. @throws InputError if it is no longer the same
Packing<2> read_again(const std::string& file, const std::string& sha256) {
  if (sha256_of_file(file) != sha256)
    throw InputError(file, "has changed since the scene was read: expected the state it starts from");
  return std::get<State<2>>(read_state(file)).packing;
}

/// Number of copies along each axis.
Vec<2, int> read_copies(TableReader& t) {
  const std::vector<double> copies =
      t.numbers("copies", {[](double n) { return n >= 1 && n <= kMaxGrains && n == std::floor(n); },
                           "two whole numbers of copies, along the first and the second axis, e.g. [10, 10]"});
  if (copies.size() == 2) return {static_cast<int>(copies[0]), static_cast<int>(copies[1])};
  if (!copies.empty())
    t.fault("copies", fmt::format("assembly.copies: {} numbers, expected two, e.g. [10, 10]", copies.size()));
  return Vec<2, int>::Ones();
}

/// Why a run cannot start from a state; empty if it can.
std::string refusal_of(const AnyState& any, const Scene& scene) {
  const State<2>* state = std::get_if<State<2>>(&any);
  if (!state) return "dimension = 3: expected a state of disks; scenes are relaxed in the plane only";
  if (state->units != scene.units)
    return fmt::format("units = \"{}\": expected those of the scene, \"{}\"", state->units, scene.units);
  const Cell<2>& cell = state->packing.cell;
  if (!cell.rectangular() || cell.matrix.diagonal().minCoeff() <= 0.0)
    return "cell/matrix is skewed or turned: expected a rectangular cell along the axes, whose sides can "
           "follow the "
           "load";
  return "";
}

/// The grains as a scene describes them: number, sizes, density of the heaviest.
GrainOptions grains_of(const Grains<2>& grains, int n_tiles) {
  GrainOptions out;
  out.count = n_tiles * grains.size();
  out.diameter.kind = DiameterDistribution::Kind::list;
  const auto [smallest, largest] = std::minmax_element(grains.radius.begin(), grains.radius.end());
  out.diameter.min = 2.0 * *smallest;
  out.diameter.max = 2.0 * *largest;
  const auto heaviest = std::max_element(grains.mass.begin(), grains.mass.end()) - grains.mass.begin();
  const double radius = grains.radius[static_cast<std::size_t>(heaviest)];
  out.density = grains.mass[static_cast<std::size_t>(heaviest)] / (std::numbers::pi * radius * radius);
  return out;
}

std::string start_description(const State<2>& state, const std::string& file, const Scene& scene) {
  const LawParameters& law = state.packing.law;
  const Vec<2, int>& copies = scene.assembly.saved.copies;
  return fmt::format("{}, {} grains at phi = {:.6g} under P = {:.4g}, {} x {} copies; contact law {}", file,
                     state.packing.grains.size(), scene.assembly.solid_fraction, state.target_stress.mean(),
                     copies[0], copies[1],
                     law == scene.law ? "as in the state" : "of the scene, in place of " + law_text(law));
}

}  // namespace

void read_saved_start(TableReader& t, const std::string& directory, Scene& scene) {
  const auto name = t.text("state", "the name of a state file");
  const auto expected = t.text("state_sha256", "the SHA-256 of the state, written by floc", Need::optional);
  SavedStart& start = scene.assembly.saved;
  start.copies = read_copies(t);
  if (!name) return;
  const std::string file = (std::filesystem::path(directory) / *name).string();
  try {
    const AnyState any = read_state(file);
    start.sha256 = sha256_of_file(file);
    const std::string refusal = refusal_of(any, scene);
    if (!refusal.empty()) return t.fault("state", fmt::format("assembly.state: {}: {}", file, refusal));
    if (expected && *expected != start.sha256)
      t.fault("state_sha256",
              fmt::format("assembly.state_sha256 = {}: {} has {}; expected the same state, or no "
                          "such key",
                          *expected, file, start.sha256));
    const State<2>& state = std::get<State<2>>(any);
    const double n_grains = 1.0 * start.copies[0] * start.copies[1] * state.packing.grains.size();
    if (n_grains < 2 || n_grains > kMaxGrains) {
      start.copies.setOnes();
      t.fault("copies", fmt::format("assembly.copies: {:g} grains, expected 2 to 1e8", n_grains));
    }
    scene.grains = grains_of(state.packing.grains, start.copies.prod());
    scene.assembly.solid_fraction = solid_fraction(state.packing);
    scene.start = start_description(state, file, scene);
    start.read = [file, sha256 = start.sha256] { return read_again(file, sha256); };
  } catch (const InputError& error) {
    t.fault("state", fmt::format("assembly.state: {}", error.what()));
  }
}

}  // namespace floc
