#include "floc/run_directory/path_row.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "floc/io/table.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/law/contact_energy.h"
#include "floc/packing/least_mechanisms.h"
#include "floc/packing/wall_forces.h"
#include "floc/rigid/static_forces.h"
#include "floc/structure/axial_test.h"
#include "floc/structure/coordination.h"

namespace floc {
namespace {

const std::vector<std::string> kColumns = {"step",
                                           "branch",
                                           "P_star",
                                           "P",
                                           "phi",
                                           "void_ratio",
                                           "L1",
                                           "L2",
                                           "z",
                                           "z_plus",
                                           "z_minus",
                                           "z_zero",
                                           "n_contacts",
                                           "n_distant",
                                           "x0",
                                           "residual_force",
                                           "residual_moment",
                                           "residual_stress",
                                           "kinetic_energy",
                                           "n_negative",
                                           "time",
                                           "n_steps",
                                           "seconds",
                                           "state",
                                           "ending"};

std::vector<std::string> columns_of(int dimension, bool boxed, bool rigid) {
  std::vector<std::string> columns = kColumns;
  if (dimension == 3) columns.emplace_back("L3");
  for (const char* quantity : {"stress", "strain"})
    for (int a = 1; a <= dimension; ++a) columns.push_back(fmt::format("{}_{}", quantity, a));
  for (const char* name : {"p", "q", "K0", "volumetric_strain", "mobilised_friction", "dilatancy", "control",
                           "axis", "shear_strain", "shear_stress"})
    columns.emplace_back(name);
  if (boxed) {
    for (const char* name : {"n_wall_contacts", "z_wall", "kinetic_over_elastic", "n_mechanisms"})
      columns.emplace_back(name);
    for (int a = 1; a <= dimension; ++a) columns.push_back(fmt::format("p_wall_{}", a));
    for (int a = 1; a <= dimension; ++a) columns.push_back(fmt::format("p_friction_{}", a));
  }
  if (rigid)
    for (const char* name : {"z_pairs", "n_sweeps", "n_unfinished", "deepest_overlap", "force_freedom"})
      columns.emplace_back(name);
  columns.insert(columns.end(), {"P_driven", "P_driven_star"});
  if (rigid) columns.insert(columns.end(), {"inertial_number", "step_residual"});
  return columns;
}

/// Adds to a row of path.csv the stress and strain along each axis, then the quantities of a test that drives one axis:
/// mean stress, deviator, lateral stress ratio K0, volumetric strain, mobilised friction and so on. If the load stage
/// drives no axis, mean stress, deviator, K0 and volumetric strain are given for the last axis, and the other cells are
/// empty.
template <int Dim>
void add_axes(const State<Dim>& state, const PathReference<Dim>& reference, std::vector<TableValue>& row) {
  const Vec<Dim> stress = state.stress.diagonal();
  const Vec<Dim> sides = state.packing.cell.matrix.diagonal();
  const Vec<Dim> strain = axial_strain<Dim>(reference.first_sides, sides);
  Vec<Dim> before;
  if (reference.sides_before) before = axial_strain<Dim>(reference.first_sides, *reference.sides_before);
  const bool is_test = !state.path.turn.empty();
  const AxialTest test = measure_axial_test<Dim>(is_test ? state.path.turn.axis : Dim - 1, stress, strain,
                                                 reference.sides_before ? &before : nullptr);
  row.insert(row.end(), stress.begin(), stress.end());
  row.insert(row.end(), strain.begin(), strain.end());
  row.emplace_back(test.mean_stress);
  row.emplace_back(test.deviator);
  // In a cell without load, the ratio of two stresses is one of rounding errors.
  const bool is_unloaded = state.packing.walls.empty() && state.target_stress.isZero(0.0);
  row.push_back(is_unloaded ? TableValue{} : TableValue{test.lateral_ratio});
  row.emplace_back(test.volumetric_strain);
  const StageReference& turn = state.path.turn;
  const bool is_sheared = turn.is_simple_shear();
  // The shear stress is positive if it resists a positive shear strain. In a simple shear, the mobilised friction is
  // the ratio of the shear stress to the normal stress on the planes perpendicular to `turn.axis`.
  const double shear_stress = is_sheared ? -state.stress(0, turn.axis) : 0.0;
  const double mobilised = is_sheared ? shear_stress / stress[turn.axis] : test.mobilised;
  row.push_back(is_test ? TableValue{mobilised} : TableValue{});
  row.push_back(is_test && !is_sheared ? or_undefined(test.dilatancy) : TableValue{});
  row.push_back(or_undefined(turn.control));
  row.push_back(is_test ? TableValue{std::int64_t{turn.axis + 1}} : TableValue{});
  row.push_back(is_sheared ? TableValue{turn.shear} : TableValue{});
  row.push_back(is_sheared ? TableValue{shear_stress} : TableValue{});
}

/// Adds to a row of path.csv the values that describe the walls. For each axis with walls, two of these values are the
/// pressure on its two walls, and the part of this pressure that is balanced by friction on the walls parallel to the
/// axis.
template <int Dim>
void add_walls(const State<Dim>& state, const Coordination& c, std::vector<TableValue>& row) {
  const Packing<Dim>& packing = state.packing;
  const Vec<Dim> pressure = wall_pressure(packing), borne = stress_borne_by_friction(packing);
  const auto n_on_walls =
      std::count_if(packing.contacts.begin(), packing.contacts.end(),
                    [&](const auto& contact) { return packing.is_wall(contact.j) && !contact.distant; });
  row.emplace_back(std::int64_t{n_on_walls});
  row.emplace_back(c.z + static_cast<double>(n_on_walls) / packing.grains.size());
  // Rigid contacts have no springs and store no energy.
  const bool rigid = packing.law.is_rigid();
  row.push_back(rigid ? TableValue{} : TableValue{kinetic_over_elastic_energy(packing)});
  row.push_back(rigid ? TableValue{} : TableValue{std::int64_t{least_mechanisms(packing)}});
  for (const Vec<Dim>* values : {&pressure, &borne})
    for (int a = 0; a < Dim; ++a) {
      row.emplace_back();
      if (between_walls(packing.walls, a)) row.back() = (*values)[a];
    }
}

/// Adds to a row of path.csv the values that describe contact dynamics and the forces of rigid grains.
template <int Dim>
void add_rigid(const State<Dim>& state, std::vector<TableValue>& row) {
  const StepCounts& counts = state.path.counts;
  row.emplace_back(2.0 * static_cast<double>(n_touching_pairs(state.packing)) / state.packing.grains.size());
  row.emplace_back(counts.n_sweeps);
  row.emplace_back(counts.n_unfinished);
  row.emplace_back(counts.deepest_overlap);
  row.push_back(or_undefined(force_freedom(state)));
}

}  // namespace

std::string path_header(int dimension, bool boxed, bool rigid) {
  return fmt::format("{}", fmt::join(columns_of(dimension, boxed, rigid), ","));
}

template <int Dim>
std::string path_row(const State<Dim>& state, const PathReference<Dim>& reference,
                     std::optional<double> seconds, const std::string& file) {
  const double pressure = state.target_stress.mean();
  const double phi = solid_fraction(state.packing);
  const double zero_force = state.tolerance.force * force_scale(state.packing, state.target_stress).force;
  const Coordination c = coordination(state.packing, zero_force);
  Table table;
  const bool boxed = !state.packing.walls.empty();
  const bool rigid = state.packing.law.is_rigid();
  table.columns = columns_of(Dim, boxed, rigid);
  table.rows = {{std::int64_t{state.path.step},
                 state.path.branch,
                 reduced_pressure(state.packing, pressure),
                 pressure,
                 phi,
                 1.0 / phi - 1.0,
                 state.packing.cell.matrix(0, 0),
                 state.packing.cell.matrix(1, 1),
                 c.z,
                 c.z_plus,
                 c.z_minus,
                 c.z_zero,
                 std::int64_t{c.n_contacts},
                 std::int64_t{c.n_distant},
                 c.rattler_fraction,
                 state.residuals.force,
                 state.residuals.moment,
                 state.residuals.stress,
                 state.residuals.energy,
                 state.n_negative < 0 ? TableValue{} : TableValue{std::int64_t{state.n_negative}},
                 state.path.time,
                 state.path.n_steps,
                 or_undefined(seconds),
                 file,
                 or_undefined(state.path.ending)}};
  if constexpr (Dim == 3) table.rows[0].emplace_back(state.packing.cell.matrix(2, 2));
  add_axes(state, reference, table.rows[0]);
  if (boxed) add_walls(state, c, table.rows[0]);
  if (rigid) add_rigid(state, table.rows[0]);
  const double driven = stress_on_driven_axis<Dim>(state, state.target_stress);
  table.rows[0].insert(table.rows[0].end(), {driven, reduced_pressure(state.packing, driven)});
  if (rigid)
    table.rows[0].insert(table.rows[0].end(),
                         {state.motion ? TableValue{state.motion->inertial_number} : TableValue{},
                          state.motion ? TableValue{state.motion->residual} : TableValue{}});
  std::stringstream text;
  write_table(text, table, TableFormat::csv);
  std::string line;
  std::getline(text, line);  // skips the first line, which has the names of the columns
  std::getline(text, line);
  return line;
}

template std::string path_row(const State<2>&, const PathReference<2>&, std::optional<double>,
                              const std::string&);
template std::string path_row(const State<3>&, const PathReference<3>&, std::optional<double>,
                              const std::string&);

}  // namespace floc
