#include "floc/io/state_equilibrium.h"

#include <fmt/format.h>

#include <vector>

#include "floc/base/error.h"

namespace floc {
namespace {

constexpr Field kStress = {"equilibrium/stress", Quantity::stress, "static stress, positive in compression"};
constexpr Field kTarget = {"equilibrium/target", Quantity::stress,
                           "stress on each axis: imposed or, if a length is imposed on the axis, carried"};
constexpr Field kSides = {"equilibrium/target_side", Quantity::length,
                          "length of the cell imposed on each axis; 0: a stress is imposed"};
constexpr Field kOffset = {
    "equilibrium/target_offset", Quantity::length,
    "in simple shear, imposed first component of the lattice vector of the sheared axis"};
constexpr Field kGravityField = {"equilibrium/gravity", Quantity::acceleration,
                                 "acceleration due to gravity; absent: zero"};
constexpr Field kTurnShear = {"path/turn_shear", Quantity::ratio,
                              "in simple shear, shear strain since the start of the stage"};
constexpr Field kTurnSides = {"path/turn_sides", Quantity::length,
                              "sides of the cell at the start of the stage"};
constexpr Field kTurnStress = {"path/turn_stress", Quantity::stress,
                               "stress on each axis at the start of the stage"};
constexpr Field kResiduals = {"equilibrium/residuals", Quantity::ratio,
                              "residual force, moment, stress and kinetic energy per grain, in units of F1, "
                              "F1 a, F1/a^(D-1) and F1 a, where F1 = max(F0, P a^(D-1)), F0 is the adhesive "
                              "force, P the pressure, a the largest diameter and D the dimension"};
constexpr Field kTolerances = {"equilibrium/tolerances", Quantity::ratio,
                               "limits of the residuals in equilibrium"};
constexpr Field kNegative = {"equilibrium/n_negative", Quantity::count,
                             "number of negative eigenvalues of the stiffness matrix; -1: not determined"};
constexpr Field kUnsettled = {
    "equilibrium/n_bridges_unsettled", Quantity::count,
    "number of liquid bridges that would form or break if the liquid were distributed once more; "
    "-1: not determined"};

}  // namespace

template <int Dim>
void write_equilibrium(WritingArchive& archive, const State<Dim>& s) {
  const Residuals& r = s.residuals;
  const EquilibriumTolerance& t = s.tolerance;
  archive.matrix(kStress, s.stress);
  archive.put(kTarget, {Dim}, std::vector<double>(s.target_stress.begin(), s.target_stress.end()));
  archive.put(kResiduals, {4}, std::vector<double>{r.force, r.moment, r.stress, r.energy});
  archive.put(kTolerances, {4}, std::vector<double>{t.force, t.moment, t.stress, t.energy});
  archive.put(kNegative, {}, std::vector<std::int32_t>{s.n_negative});
  if (!s.packing.gravity.isZero(0.0))
    archive.put(kGravityField, {Dim}, std::vector<double>(s.packing.gravity.begin(), s.packing.gravity.end()));
  if (s.packing.law.liquid()) archive.put(kUnsettled, {}, std::vector<std::int32_t>{s.n_bridges_unsettled});
}

template <int Dim>
void write_directed_load(Hdf5Writer& file, WritingArchive& archive, const State<Dim>& s) {
  if (!s.target_side.isZero(0.0))
    archive.put(kSides, {Dim}, std::vector<double>(s.target_side.begin(), s.target_side.end()));
  const StageReference& turn = s.path.turn;
  if (turn.empty()) return;
  file.attribute("path", "control", turn.control);
  file.attribute("path", "axis", std::int64_t{turn.axis + 1});
  archive.put(kTurnSides, {Dim}, turn.sides);
  archive.put(kTurnStress, {Dim}, turn.stress);
  if (!s.target_offset) return;
  archive.put(kOffset, {1}, std::vector<double>{s.target_offset->offset});
  archive.put(kTurnShear, {1}, std::vector<double>{turn.shear});
}

template <int Dim>
void read_directed_load(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& s) {
  if (file.has(kSides.path)) {
    const auto side = archive.take<double>(kSides, {Dim});
    for (int a = 0; a < Dim; ++a) s.target_side[a] = side[a];
  }
  if (!file.has_attribute("path", "control")) return;
  StageReference& turn = s.path.turn;
  std::int64_t axis = 0;
  file.attribute("path", "control", turn.control);
  file.attribute("path", "axis", axis);
  if (axis < 1 || axis > Dim)
    throw InputError(file.place("path"), fmt::format("axis = {}, expected 1 to {}", axis, Dim));
  turn.axis = static_cast<int>(axis) - 1;
  turn.sides = archive.take<double>(kTurnSides, {Dim});
  turn.stress = archive.take<double>(kTurnStress, {Dim});
  if (!file.has(kOffset.path)) return;
  if (turn.axis == 0)
    throw InputError(file.place("path"),
                     "axis = 1, expected the axis, other than the first, whose lattice vector the simple shear "
                     "displaces along the first axis");
  s.target_offset = ImposedOffset{turn.axis, archive.take<double>(kOffset, {1})[0]};
  turn.shear = archive.take<double>(kTurnShear, {1})[0];
}

template <int Dim>
void read_equilibrium(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& s) {
  const auto target = archive.take<double>(kTarget, {Dim});
  for (int a = 0; a < Dim; ++a) s.target_stress[a] = target[a];
  archive.matrix(kStress, s.stress);
  if (file.has(kGravityField.path)) {
    const auto gravity = archive.take<double>(kGravityField, {Dim});
    for (int a = 0; a < Dim; ++a) s.packing.gravity[a] = gravity[a];
  }
  // It is not checked that the residuals are finite: a residual may be infinite, because the unit of residuals is zero
  // in a packing without pressure and without adhesion.
  std::vector<double> r;
  file.array(kResiduals.path, {4}, r);
  s.residuals.force = r[0], s.residuals.moment = r[1], s.residuals.stress = r[2], s.residuals.energy = r[3];
  const auto t = archive.take<double>(kTolerances, {4});
  s.tolerance = {t[0], t[1], t[2], t[3]};
  s.n_negative = archive.take<std::int32_t>(kNegative, {})[0];
  if (file.has(kUnsettled.path)) s.n_bridges_unsettled = archive.take<std::int32_t>(kUnsettled, {})[0];
}

#define FLOC_INSTANTIATE(Dim)                                                         \
  template void write_equilibrium(WritingArchive&, const State<Dim>&);                \
  template void write_directed_load(Hdf5Writer&, WritingArchive&, const State<Dim>&); \
  template void read_equilibrium(const Hdf5Reader&, ReadingArchive&, State<Dim>&);    \
  template void read_directed_load(const Hdf5Reader&, ReadingArchive&, State<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
