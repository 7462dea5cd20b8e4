#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <map>

#include "columns.h"
#include "command.h"
#include "equilibrium_check.h"
#include "floc/base/error.h"
#include "floc/base/seconds_since.h"
#include "floc/elasticity/force_correlation.h"
#include "floc/elasticity/mechanisms.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/network/carrying_structure.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/require_periodic.h"
#include "floc/structure/carrying_forces.h"
#include "floc/structure/coordination.h"
#include "floc/structure/elastic_energy.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/force_moments.h"
#include "floc/structure/particle_stress.h"
#include "floc/structure/pressure_phases.h"
#include "network_bonds.h"
#include "output.h"
#include "repeated_warnings.h"

namespace floc {
namespace {

constexpr ForceKind kKinds[] = {ForceKind::normal, ForceKind::tangential, ForceKind::rolling};

struct NetworkCommand {
  std::vector<std::string> files;
  std::optional<double> zero_force;   ///< in F1; the state's own tolerance when absent
  std::optional<int> least_contacts;  ///< of a grain that is held; least_contacts() when absent
  std::string distributions;          ///< file for the force distributions; empty: none
  std::string unit = "mean";
  double bin_width = 0.1;
  std::string pressures;  ///< file for the particle stresses; empty: none
  BondArguments bonds;
  std::string format;
};

/// One row: what the contact network of a state is like.
struct NetworkRow {
  std::string file;
  std::string units;
  int dimension;
  int n_grains;
  double pressure;
  double reduced_pressure;
  double solid_fraction;
  Coordination coordination;
  ForceMoments moments;
  PressurePhases phases;
  NetworkMechanics mechanics;
  ForceCorrelation correlation;
  CarryingForces carrying;
  Indeterminacy hyperstaticity;
  double energy;
  std::optional<double> contact_pressure;
  double stress_spread;
  BondRow bonds;
  double seconds;
};

/// Counts of forces by kind, of all states together.
using Pooled = std::map<ForceKind, ForceDistribution>;

/// Rows that go to files beside the main table.
struct SideTables {
  Table distributions{{"file", "kind", "unit_force", "low", "high", "count", "n", "density"}, {}};
  Table pressures;
  Pooled pooled;
  BondTables bonds;
};

/// The force-carrying structure: what it is like, and its degree of hyperstaticity.
/// @param network, response  of all contacts that carry or might, taken over where they are the same
template <int Dim>
void add_carrying(const State<Dim>& state, const NetworkCommand& command, double zero_force,
                  const ContactNetwork<Dim>& network, const ElasticResponse& response, NetworkRow& row) {
  const Packing<Dim>& packing = state.packing;
  const CarryingStructure held =
      carrying_structure(packing, zero_force * force_scale(packing, state.target_stress).force,
                         command.least_contacts.value_or(least_contacts(packing)));
  row.carrying = carrying_forces(packing, held);
  const bool same = held.contacts.size() == network.contacts.size() &&
                    std::ranges::equal(held.contacts, network.contacts, {}, {}, &NetworkContact<Dim>::source);
  if (same) {
    row.hyperstaticity = force_indeterminacy(network, response);
  } else {
    const ContactNetwork<Dim> carrying = carrying_network(packing, held);
    row.hyperstaticity = force_indeterminacy(carrying, elastic_response(carrying, {}));
  }
}

template <int Dim>
void add_mechanics(const State<Dim>& state, const NetworkCommand& command, double zero_force, NetworkRow& row) {
  ModuliOptions options;
  options.force_tolerance = zero_force;
  options.unloaded = state.target_stress.isZero(0.0);
  const ContactNetwork<Dim> network = options.loaded_network(state.packing);
  const Moduli moduli = elastic_moduli(state.packing, options);
  const ContactMechanics<Dim> contacts = contact_mechanics(network, moduli);
  row.mechanics = network_mechanics(state.packing, network, moduli, contacts);
  add_carrying(state, command, zero_force, network, moduli.response, row);
  if (contacts.isotropic) row.correlation = force_correlation(network, contacts.isotropic->increments);
  const auto vanishing =
      strain_mechanisms<Dim>(moduli.response, affine_stiffness(network, StrainSet::diagonal)).vanishing;
  if (!vanishing.empty()) warn(row.file, fmt::format("moduli that vanish: {}", fmt::join(vanishing, ", ")));
}

template <int Dim>
void add_contacts_and_stress(const Packing<Dim>& packing, NetworkRow& row) {
  row.energy = elastic_energy_per_grain(packing);
  if constexpr (Dim == 3) row.contact_pressure = largest_contact_pressure(packing);
  const Vec<Dim> stress = static_stress(packing).diagonal();
  row.stress_spread = stress.maxCoeff() - stress.minCoeff();
}

void add_distribution(const std::string& file, ForceKind kind, const ForceDistribution& d, Table& table) {
  for (int b = 0; b < static_cast<int>(d.counts.size()); ++b)
    table.rows.push_back({file, name_of(kind), d.unit, d.low(b), d.low(b + 1), d.counts[b], d.n, d.density(b)});
}

template <int Dim>
void add_distributions(const std::string& file, const Packing<Dim>& packing, const NetworkCommand& command,
                       SideTables& side) {
  const ForceUnit unit = command.unit == "F0"  ? ForceUnit::pull_off
                         : command.unit == "P" ? ForceUnit::pressure
                                               : ForceUnit::mean;
  for (const ForceKind kind : kKinds) {
    const ForceDistribution d = force_distribution(packing, kind, unit, command.bin_width);
    if (d.n == 0 && kind == ForceKind::normal)
      warn(file, fmt::format("no force to measure normal forces in: {}",
                             unit == ForceUnit::mean       ? "all are zero"
                             : unit == ForceUnit::pressure ? "P is not positive, take --unit mean"
                                                           : "F0 = 0, take --unit mean"));
    add_distribution(file, kind, d, side.distributions);
    side.pooled[kind].add(d);
  }
}

template <int Dim>
void add_pressures(const std::string& file, const Packing<Dim>& packing, const std::vector<Mat<Dim>>& stress,
                   Table& table) {
  std::vector<std::string> names = {"file", "grain"};
  for (int a = 1; a <= Dim; ++a) names.push_back(fmt::format("x{}", a));
  names.insert(names.end(), {"radius", "pressure"});
  for (int a = 1; a <= Dim; ++a)
    for (int b = 1; b <= Dim; ++b) names.push_back(fmt::format("stress{}{}", a, b));
  expect_columns(file, names, table);
  for (int i = 0; i < packing.grains.size(); ++i) {
    std::vector<TableValue> values = {file, count(i)};
    for (int a = 0; a < Dim; ++a) values.emplace_back(packing.grains.position[i][a]);
    values.emplace_back(packing.grains.radius[i]);
    values.emplace_back(stress[i].trace() / Dim);
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) values.emplace_back(stress[i](a, b));
    table.rows.push_back(std::move(values));
  }
}

template <int Dim>
NetworkRow network_row(const std::string& file, const State<Dim>& state, const NetworkCommand& command,
                       SideTables& side) {
  const auto start = std::chrono::steady_clock::now();
  const Packing<Dim>& packing = state.packing;
  require_periodic(packing, "the force network is measured", file);
  if (const std::string faults = equilibrium_faults(state); !faults.empty())
    warn(file, "this state is not in equilibrium: " + faults, equilibrium_excess(state));
  NetworkRow row;
  row.file = file;
  row.units = state.units;
  row.dimension = Dim;
  row.n_grains = packing.grains.size();
  row.pressure = static_stress(packing).trace() / Dim;
  row.reduced_pressure = reduced_pressure(packing, row.pressure);
  row.solid_fraction = solid_fraction(packing);
  const double tolerance = command.zero_force.value_or(state.tolerance.force);
  row.coordination = coordination(packing, tolerance * force_scale(packing, state.target_stress).force);
  row.moments = force_moments(packing);
  const std::vector<Mat<Dim>> stress = particle_stress(packing);
  std::vector<double> pressure;
  for (const Mat<Dim>& s : stress) pressure.push_back(s.trace() / Dim);
  row.phases = pressure_phases(contact_network(packing), pressure);
  add_mechanics(state, command, tolerance, row);
  add_contacts_and_stress(packing, row);
  row.bonds = bond_row(file, packing, pressure, tolerance * force_scale(packing, state.target_stress).force,
                       command.bonds, side.bonds);
  if (!command.distributions.empty()) add_distributions(file, packing, command, side);
  if (!command.pressures.empty()) add_pressures(file, packing, stress, side.pressures);
  row.seconds = seconds_since(start);
  return row;
}

std::vector<Column<NetworkRow>> carrying_columns() {
  using Row = NetworkRow;
  std::vector<Column<Row>> columns = {
      {"n_carrying", [](const Row& r) { return count(r.carrying.n_contacts); }},
      {"z_carrying", [](const Row& r) { return r.carrying.z; }},
      {"x0_carrying", [](const Row& r) { return r.carrying.x0; }},
      {"x2", [](const Row& r) { return r.carrying.x2; }},
      {"z_star_carrying", [](const Row& r) { return r.carrying.z_star; }},
      {"z_star_star", [](const Row& r) { return or_undefined(r.carrying.z_star_star); }},
      {"hyperstaticity", [](const Row& r) { return count(r.hyperstaticity.degree); }},
      {"n_null_modes", [](const Row& r) { return count(r.hyperstaticity.n_null_modes); }},
      {"Z_1_3", [](const Row& r) { return r.carrying.Z_third; }},
      {"Z_5_3", [](const Row& r) { return r.carrying.Z_five_thirds; }},
      {"Z_2", [](const Row& r) { return r.carrying.Z2; }},
      {"M1_carrying", [](const Row& r) { return r.carrying.M1; }},
      {"M2_carrying", [](const Row& r) { return r.carrying.M2; }},
      {"sliding_share", [](const Row& r) { return r.carrying.sliding_share; }},
      {"energy_per_grain", [](const Row& r) { return r.energy; }},
      {"p_max", [](const Row& r) { return or_undefined(r.contact_pressure); }},
      {"stress_spread", [](const Row& r) { return r.stress_spread; }}};
  const std::pair<const char*, Eigen::MatrixXd CarryingForces::*> fabrics[] = {
      {"fabric", &CarryingForces::fabric},
      {"strong_fabric", &CarryingForces::strong_fabric},
      {"weak_fabric", &CarryingForces::weak_fabric}};
  for (const auto& [name, fabric] : fabrics)
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b)
        columns.emplace_back(fmt::format("{}{}{}", name, a + 1, b + 1), [a, b, fabric = fabric](const Row& r) {
          return b < r.dimension ? TableValue{(r.carrying.*fabric)(a, b)} : TableValue{};
        });
  return columns;
}

std::vector<Column<NetworkRow>> counted_columns() {
  using Row = NetworkRow;
  return {{"file", [](const Row& r) { return r.file; }},
          {"dimension", [](const Row& r) { return count(r.dimension); }},
          {"n_grains", [](const Row& r) { return count(r.n_grains); }},
          {"n_contacts", [](const Row& r) { return count(r.coordination.n_contacts); }},
          {"n_distant", [](const Row& r) { return count(r.coordination.n_distant); }},
          {"P", [](const Row& r) { return r.pressure; }},
          {"P_star", [](const Row& r) { return r.reduced_pressure; }},
          {"phi", [](const Row& r) { return r.solid_fraction; }},
          {"z", [](const Row& r) { return r.coordination.z; }},
          {"z_plus", [](const Row& r) { return r.coordination.z_plus; }},
          {"z_minus", [](const Row& r) { return r.coordination.z_minus; }},
          {"z_zero", [](const Row& r) { return r.coordination.z_zero; }},
          {"z_with_distant",
           [](const Row& r) { return r.coordination.z + 2.0 * r.coordination.n_distant / r.n_grains; }},
          {"n_rattlers", [](const Row& r) { return count(r.coordination.n_rattlers); }},
          {"x0", [](const Row& r) { return r.coordination.rattler_fraction; }},
          {"z_star", [](const Row& r) { return r.coordination.z_star; }},
          {"x22", [](const Row& r) { return r.coordination.x22; }}};
}

std::vector<Column<NetworkRow>> force_columns() {
  using Row = NetworkRow;
  return {{"mean_normal_force", [](const Row& r) { return r.moments.mean_normal; }},
          {"largest_normal_force", [](const Row& r) { return r.moments.largest; }},
          {"moment_2", [](const Row& r) { return r.moments.Z[0]; }},
          {"moment_3", [](const Row& r) { return r.moments.Z[1]; }},
          {"moment_4", [](const Row& r) { return r.moments.Z[2]; }},
          {"M1", [](const Row& r) { return r.moments.M1; }},
          {"M2", [](const Row& r) { return r.moments.M2; }},
          {"pressed_share", [](const Row& r) { return r.phases.positive.share; }},
          {"pressed_mean", [](const Row& r) { return r.phases.positive.mean; }},
          {"pressed_largest", [](const Row& r) { return count(r.phases.positive.largest_cluster); }},
          {"pressed_percolates", [](const Row& r) { return count(r.phases.positive.n_directions); }},
          {"pulled_share", [](const Row& r) { return r.phases.negative.share; }},
          {"pulled_mean", [](const Row& r) { return r.phases.negative.mean; }},
          {"pulled_largest", [](const Row& r) { return count(r.phases.negative.largest_cluster); }},
          {"pulled_percolates", [](const Row& r) { return count(r.phases.negative.n_directions); }}};
}

std::vector<Column<NetworkRow>> mechanics_columns() {
  using Row = NetworkRow;
  return {
      {"indeterminacy", [](const Row& r) { return count(r.mechanics.indeterminacy.degree); }},
      {"n_dead_ends", [](const Row& r) { return count(r.mechanics.n_dead_ends); }},
      {"n_components", [](const Row& r) { return count(r.mechanics.n_components); }},
      {"n_percolating", [](const Row& r) { return count(r.mechanics.n_percolating); }},
      {"energy_share_95", [](const Row& r) { return or_undefined(r.mechanics.energy_share_95); }},
      {"energy_share_95_deviatoric",
       [](const Row& r) { return or_undefined(r.mechanics.energy_share_95_deviatoric); }},
      {"backbone_share", [](const Row& r) { return or_undefined(r.mechanics.backbone_share); }},
      {"scalar_backbone_share", [](const Row& r) { return or_undefined(r.mechanics.scalar_backbone_share); }},
      {"correlation_normal", [](const Row& r) { return or_undefined(r.correlation.normal); }},
      {"correlation_size", [](const Row& r) { return or_undefined(r.correlation.size); }},
      {"seconds", [](const Row& r) { return r.seconds; }},
      {"units", [](const Row& r) { return r.units; }}};
}

int run_network(const NetworkCommand& command) {
  std::vector<NetworkRow> rows;
  SideTables side;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any) {
    std::visit([&](const auto& state) { rows.push_back(network_row(file, state, command, side)); }, any);
    return int{kDone};
  });
  if (rows.size() > 1)
    for (const auto& [kind, distribution] : side.pooled)
      add_distribution("pooled", kind, distribution, side.distributions);
  if (!command.distributions.empty()) write_csv(command.distributions, side.distributions);
  if (!command.pressures.empty()) write_csv(command.pressures, side.pressures);
  write_bond_tables(command.bonds, rows.size(), side.bonds);
  std::vector<Column<NetworkRow>> columns = counted_columns();
  for (const auto& more : {force_columns(), mechanics_columns(), carrying_columns()})
    columns.insert(columns.end(), more.begin(), more.end());
  for (const auto& [name, value] : bond_columns(command.bonds))
    columns.emplace_back(name, [value = value](const NetworkRow& r) { return value(r.bonds); });
  print_table(to_table(columns, rows), command.format);
  return code;
}

}  // namespace

Command add_network(CommandLine program) {
  CommandLine app = program.add_subcommand("network",
                                           "Describe the contact networks of saved states: coordination, "
                                           "forces, particle pressures, what carries the load");
  const auto command = std::make_shared<NetworkCommand>();
  add_states_argument(app, command->files);
  app.add_option("--zero-force", command->zero_force,
                 "a normal force below this is zero, in max(F0, P a^(d-1)) [the force tolerance of the state]")
      .non_negative();
  app.add_option(
         "--least-contacts", command->least_contacts,
         "contacts above that force which hold a grain of the force-carrying structure [2 where a contact "
         "carries a tangential force, else d+1]")
      .between(1, 100);
  app.add_option("--pdf", command->distributions,
                 "file for distributions of normal forces (with sign), tangential forces and rolling moments, "
                 "a row a bin");
  app.add_option("--unit", command->unit,
                 "of these: mean (of the sizes of their kind), F0 (moments F0 a) or P (P a^(d-1))")
      .one_of({"mean", "F0", "P"})
      .show_default();
  app.add_option("--bin-width", command->bin_width, "of these, in that unit").positive().show_default();
  app.add_option("--particle-stress", command->pressures, "file for the pressure and stress of each grain");
  add_bond_options(app, command->bonds);
  add_format_option(app, command->format);
  return {app, [command] { return run_network(*command); }};
}

}  // namespace floc
