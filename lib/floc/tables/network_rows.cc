#include "floc/tables/network_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "floc/base/processor_seconds.h"
#include "floc/elasticity/mechanisms.h"
#include "floc/network/carrying_structure.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/wall_forces.h"
#include "floc/structure/elastic_energy.h"
#include "floc/structure/long_axes.h"
#include "floc/structure/particle_stress.h"
#include "floc/tables/equilibrium_warning.h"

namespace floc {
namespace {

constexpr ForceKind kForceKinds[] = {ForceKind::normal, ForceKind::tangential, ForceKind::rolling};

/// Computes the degree of hyperstaticity (number of independent self-stresses) of the force-carrying structure `held`.
/// @param network, response  contact network with which the moduli were computed, and its elastic response. If this
/// network has the same contacts as `held`, the response is used again, to save time
template <int Dim>
Indeterminacy hyperstaticity(const Packing<Dim>& packing, const CarryingStructure& held,
                             const ContactNetwork<Dim>& network, const ElasticResponse& response) {
  const bool same = held.contacts.size() == network.contacts.size() &&
                    std::ranges::equal(held.contacts, network.contacts, {}, {}, &NetworkContact<Dim>::source);
  if (same) return force_indeterminacy(network, response);
  const ContactNetwork<Dim> carrying = carrying_network(packing, held);
  return force_indeterminacy(carrying, elastic_response(carrying, {}));
}

/// Adds to a row the values that need the elastic moduli: the mechanics of the network, the degree of hyperstaticity,
/// and the correlation of the contact forces with their increments under isotropic stress.
/// @param held  force-carrying structure of the packing
template <int Dim>
void add_mechanics(const State<Dim>& state, const CarryingStructure& held, double tolerance, NetworkRow& row,
                   const Remarks& remarks) {
  ModuliOptions options;
  options.force_tolerance = tolerance;
  options.unloaded = state.target_stress.isZero(0.0);
  const ContactNetwork<Dim> network = options.loaded_network(state.packing);
  const Moduli moduli = elastic_moduli(state.packing, options);
  const ContactMechanics<Dim> contacts = contact_mechanics(network, moduli);
  row.mechanics = network_mechanics(state.packing, network, moduli, contacts);
  row.hyperstaticity = hyperstaticity(state.packing, held, network, moduli.response);
  if (contacts.isotropic) row.correlation = force_correlation(network, contacts.isotropic->increments);
  const auto vanishing =
      strain_mechanisms<Dim>(moduli.response, affine_stiffness(network, StrainSet::diagonal)).vanishing;
  if (!vanishing.empty())
    remarks.warn(
        row.file,
        fmt::format(
            "mechanisms let the cell change its shape without elastic energy, so these moduli are zero: {}",
            fmt::join(vanishing, ", ")));
}

/// Removes the contacts with walls from a force-carrying structure. The grains that touch walls remain part of the
/// structure.
template <int Dim>
CarryingStructure between_grains(const Packing<Dim>& packing, CarryingStructure held) {
  const auto on_wall = [&](int k) { return packing.is_wall(packing.contacts[k].j); };
  for (const int k : held.contacts)
    if (on_wall(k)) --held.degree[packing.contacts[k].i];
  std::erase_if(held.contacts, on_wall);
  return held;
}

template <int Dim>
void add_contacts_and_stress(const Packing<Dim>& packing, NetworkRow& row) {
  // Rigid contacts store no energy, and their surfaces have no area of contact.
  if (!packing.law.is_rigid()) {
    row.energy = elastic_energy_per_grain(packing);
    if constexpr (Dim == 3) row.contact_pressure = largest_contact_pressure(packing);
  }
  const Vec<Dim> stress = static_stress(packing).diagonal();
  row.stress_spread = stress.maxCoeff() - stress.minCoeff();
}

/// Adds statistics of the force-carrying structure `held`: kinds of contacts, anisotropies and the distribution of
/// forces.
template <int Dim>
void add_contact_statistics(const Packing<Dim>& packing, const CarryingStructure& held, NetworkRow& row) {
  std::vector<double> by_points, by_pairs;
  for (const int k : held.contacts) {
    const Contact<Dim>& c = packing.contacts[k];
    if (!packing.is_wall(c.j) && c.normal_force > 0.0) by_points.push_back(c.normal_force);
  }
  row.force_by_points = force_shape(by_points);
  row.anisotropy = contact_anisotropy(packing, held);
  row.mobilisation = mean_mobilisation(packing, held);
  if (packing.grains.are_round()) return;
  const std::vector<ContactPair> pairs = contact_pairs(packing, held);
  row.kinds = contact_kinds(pairs, held.n_held());
  for (const ContactPair& pair : pairs)
    if (pair.normal_force > 0.0) by_pairs.push_back(pair.normal_force);
  row.force_by_pairs = force_shape(by_pairs);
  if (const auto order = long_axes_order(packing)) {
    row.long_axes_order = order->order;
    row.long_axis.assign(order->direction.begin(), order->direction.end());
  }
}

void add_distribution(const std::string& file, ForceKind kind, const ForceDistribution& d, Table& table,
                      const Remarks& remarks) {
  if (d.n_outside > 0)
    remarks.warn(file, outside_bins(d, name_of(kind) + " forces", "--bin-width or another --unit"),
                 static_cast<double>(d.n_outside));
  for (int b = 0; b < static_cast<int>(d.counts.size()); ++b)
    table.rows.push_back(
        {file, name_of(kind), d.unit, d.low(b), d.low(b + 1), d.counts[b], d.n, d.density(b), d.n_outside});
}

/// Returns the largest value of P a^(Dim-1) (force) that cannot be distinguished from zero, because the stress is in
/// equilibrium only to a tolerance (P: pressure, a: largest diameter).
template <int Dim>
double least_pressure_force(const State<Dim>& state) {
  return state.tolerance.stress * force_scale(state.packing, state.target_stress).force;
}

/// For a warning, returns the reason why the normal forces of a state cannot be expressed in a unit.
const char* why_no_unit(ForceUnit unit) {
  switch (unit) {
    case ForceUnit::pull_off:
      return "the pull-off force F0 is zero: give --unit mean";
    case ForceUnit::pressure:
      return "the pressure P cannot be distinguished from zero, because of rounding or the tolerance of "
             "equilibrium: give --unit "
             "mean";
    default:
      return "all normal forces are zero up to rounding";
  }
}

template <int Dim>
void add_distributions(const std::string& file, const State<Dim>& state, const NetworkTableOptions& options,
                       NetworkTables& side, const Remarks& remarks) {
  const Packing<Dim>& packing = state.packing;
  const ForceUnit unit = options.unit;
  const bool no_pressure =
      unit == ForceUnit::pressure && pressure_force(packing) <= least_pressure_force(state);
  for (const ForceKind kind : kForceKinds) {
    const double size = no_pressure ? 0.0 : force_unit(packing, kind, unit);
    const ForceDistribution d = distribution_of(contact_forces(packing, kind), size, options.bin_width);
    if (d.n == 0 && kind == ForceKind::normal)
      remarks.warn(file, fmt::format("the distribution of the normal forces is left out, because they cannot "
                                     "be expressed in the chosen unit: {}",
                                     why_no_unit(unit)));
    add_distribution(file, kind, d, side.distributions, remarks);
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
    std::vector<TableValue> values = {file, packing.grains.name(i)};
    for (int a = 0; a < Dim; ++a) values.emplace_back(packing.grains.position[i][a]);
    values.emplace_back(packing.grains.radius[i]);
    values.emplace_back(stress[i].trace() / Dim);
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) values.emplace_back(stress[i](a, b));
    table.rows.push_back(std::move(values));
  }
}

}  // namespace

ForceUnit force_unit_named(const std::string& keyword) {
  if (keyword == "F0") return ForceUnit::pull_off;
  return keyword == "P" ? ForceUnit::pressure : ForceUnit::mean;
}

template <int Dim>
NetworkRow network_row(const std::string& file, const State<Dim>& state, const NetworkTableOptions& options,
                       NetworkTables& side, const Remarks& remarks) {
  const double start = processor_seconds();
  const Packing<Dim>& packing = state.packing;
  warn_unless_in_equilibrium(file, state, remarks);
  NetworkRow row;
  row.file = file;
  row.units = state.units;
  row.dimension = Dim;
  row.n_grains = packing.grains.size();
  row.pressure = static_stress(packing).trace() / Dim;
  row.reduced_pressure = reduced_pressure(packing, row.pressure);
  row.driven_stress = stress_on_driven_axis<Dim>(state, static_stress(packing).diagonal());
  row.reduced_driven_stress = reduced_pressure(packing, row.driven_stress);
  row.wall_pressure = mean_wall_pressure(packing);
  for (const Contact<Dim>& c : packing.contacts) row.n_bonds += c.bonded;
  row.solid_fraction = solid_fraction(packing);
  // The forces balance only up to the tolerance of equilibrium. A contact with a force below this tolerance cannot be
  // distinguished from a contact without force. The user can give another tolerance.
  const double tolerance = options.zero_force.value_or(state.tolerance.force);
  const double zero_force = tolerance * force_scale(packing, state.target_stress).force;
  row.coordination = coordination(packing, zero_force);
  row.moments = force_moments(packing);
  const std::vector<Mat<Dim>> stress = particle_stress(packing);
  std::vector<double> pressure;
  for (const Mat<Dim>& s : stress) pressure.push_back(s.trace() / Dim);
  // The sign of a pressure below the tolerance would be that of the forces that are left over.
  row.phases = pressure_phases(contact_network(packing), pressure_beyond_zero(packing, pressure, zero_force));
  const CarryingStructure held =
      carrying_structure(packing, zero_force, options.least_contacts.value_or(least_contacts(packing)));
  // Contacts with walls support grains, so the search for rattlers includes these contacts. Contacts with walls are
  // removed only after this search, because `row.carrying` describes forces between grains.
  row.carrying = carrying_forces(packing, between_grains(packing, held));
  add_contact_statistics(packing, held, row);
  if (options.mechanics && packing.walls.empty()) {
    // Rigid contacts have no stiffness, so there are no elastic moduli. The indeterminacy of the forces needs no
    // stiffness, because it follows from the equations of balance and from the friction law.
    if (packing.law.is_rigid())
      row.rigid_indeterminacy = rigid_indeterminacy(packing, zero_force);
    else
      add_mechanics(state, held, tolerance, row, remarks);
  }
  add_contacts_and_stress(packing, row);
  row.bonds = bond_row(file, packing, pressure, {zero_force, least_pressure_force(state)}, options.bonds,
                       side.bonds, remarks);
  if (options.distributions) add_distributions(file, state, options, side, remarks);
  if (options.pressures) add_pressures(file, packing, stress, side.pressures);
  row.seconds = processor_seconds() - start;
  return row;
}

Table network_table(const AnyState& state, const NetworkTableOptions& options, const std::string& file,
                    NetworkTables* further, const Remarks& remarks) {
  NetworkTables side;
  NetworkTables& kept = further == nullptr ? side : *further;
  const NetworkRow row =
      std::visit([&](const auto& s) { return network_row(file, s, options, kept, remarks); }, state);
  return to_table(network_columns(options), {row});
}

void add_pooled(const NetworkTableOptions& options, std::size_t n_states, NetworkTables& side,
                const Remarks& remarks) {
  add_pooled(options.bonds, n_states, side.bonds, remarks);
  if (n_states < 2) return;
  for (const auto& [kind, distribution] : side.pooled)
    add_distribution("pooled", kind, distribution, side.distributions, remarks);
}

template NetworkRow network_row(const std::string&, const State<2>&, const NetworkTableOptions&, NetworkTables&,
                                const Remarks&);
template NetworkRow network_row(const std::string&, const State<3>&, const NetworkTableOptions&, NetworkTables&,
                                const Remarks&);

}  // namespace floc
