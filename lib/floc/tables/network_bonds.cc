#include "floc/tables/network_bonds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "floc/fitting/cut_exponential.h"
#include "floc/network/contact_network.h"
#include "floc/network/rattlers.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/particle_stress.h"

namespace floc {
namespace {

constexpr double kEnd = std::numeric_limits<double>::infinity();

std::vector<double> scaled(std::vector<double> values, double unit) {
  for (double& x : values) x /= unit;
  return values;
}

/// Values of one quantity (normal force or particle pressure). Exponential distributions are fitted to the values in
/// several windows. All numbers are in the unit `unit`.
struct Measured {
  std::string quantity, unit;
  double unit_size = 0.0;
  std::vector<double> values;  ///< values of the quantity
  std::vector<double> from;    ///< magnitudes at which the windows begin
  /// Largest magnitude that a negative value can have, at which the windows of negative values end.
  double end_of_negative = kEnd;
  /// Ends of two additional windows: `window_plus` for positive values, `window_minus` for negative values. An end is
  /// absent if there is no such window.
  std::optional<double> window_plus, window_minus;
};

/// Returns the size of a unit as a table cell. In rows for all states together, the cell is empty, because the size of
/// the unit differs between states.
TableValue size_or_none(double unit) {
  return unit > 0.0 ? TableValue{unit} : TableValue{};
}

void add_exponents(const std::string& file, const Measured& of, Table& table) {
  const std::vector<double> plus = sizes_of(of.values, 1.0), minus = sizes_of(of.values, -1.0);
  const auto add = [&](const char* side, double from, double to, const std::vector<CutSample>& windows) {
    if (!(from < to)) return;
    const ExponentEstimate fit = fit_exponent(windows);
    table.rows.push_back({file, of.quantity, of.unit, size_or_none(of.unit_size), std::string(side), from,
                          std::isinf(to) ? TableValue{} : TableValue{to}, count(fit.n),
                          fit.found ? TableValue{fit.b} : TableValue{},
                          fit.found ? TableValue{fit.error} : TableValue{}});
  };
  for (const double from : of.from) {
    const CutSample tail_plus = cut_sample(plus, from, kEnd);
    const CutSample tail_minus = cut_sample(minus, from, of.end_of_negative);
    add("+", from, kEnd, {tail_plus});
    add("-", from, of.end_of_negative, {tail_minus});
    add("both", from, kEnd, {tail_plus, tail_minus});
    if (of.window_plus) add("+", from, *of.window_plus, {cut_sample(plus, from, *of.window_plus)});
    if (of.window_minus) add("-", from, *of.window_minus, {cut_sample(minus, from, *of.window_minus)});
  }
}

/// Returns the windows of values in which exponential distributions are fitted, for one quantity in one unit. The
/// member `values` of the result is empty.
/// @param near             magnitude below which a normal force counts as near zero, in units of F0
/// @param end_of_negative  largest magnitude that a negative value can have, expressed in `unit`
Measured limits_of(const std::string& quantity, const std::string& unit, double near, double end_of_negative) {
  constexpr double kBeyondTheMiddle = 0.1;
  Measured out{quantity, unit, 0.0, {}, {0.0, 1.0}, end_of_negative, std::nullopt, std::nullopt};
  if (unit == "p0") out.from = {0.0, kBeyondTheMiddle};
  if (unit != "F0") return out;
  out.from = {0.0};
  if (near > 0.0) out.from.push_back(near);
  if (near != kBeyondTheMiddle) out.from.push_back(kBeyondTheMiddle);
  out.window_plus = 1.5;
  out.window_minus = 0.5;
  return out;
}

/// Returns the normal forces and the particle pressures, each in several units. The units of the forces are the
/// pull-off force, the mean magnitude of the forces, and P a^(Dim-1) with the pressure P and the largest diameter a.
/// The units of the pressures are p0 and the mean magnitude of the pressures. Units that are zero are left out.
/// @param unit_pressure  unit p0 of the particle pressures (stress)
template <int Dim>
std::vector<Measured> measured(const Packing<Dim>& packing, const std::vector<double>& pressure,
                               double unit_pressure, const ForceLimits& limits,
                               const BondTableOptions& options) {
  const double F0 = pull_off_force(packing);
  const bool no_pressure = pressure_force(packing) <= limits.pressure || pressure_is_noise(packing);
  const std::vector<double> forces = contact_forces(packing, ForceKind::normal);
  std::vector<Measured> all;
  const auto add = [&](const std::string& quantity, const std::string& unit, double size,
                       const std::vector<double>& values) {
    if (!(size > 0.0)) return;
    const double end = quantity == "force" && F0 > 0.0 ? F0 / size : kEnd;
    Measured m = limits_of(quantity, unit, options.near, end);
    m.unit_size = size;
    m.values = scaled(values, size);
    all.push_back(std::move(m));
  };
  add("force", "F0", F0, forces);
  add("force", "mean", force_unit(packing, ForceKind::normal, ForceUnit::mean), forces);
  add("force", "P", no_pressure ? 0.0 : pressure_force(packing), forces);
  add("pressure", "p0", F0 == 0.0 && no_pressure ? 0.0 : unit_pressure, pressure);
  add("pressure", "mean", mean_size(pressure), pressure);
  return all;
}

void add_histogram(const std::string& file, const std::vector<double>& pressures, double unit, double width,
                   Table& table, const Remarks& remarks) {
  const ForceDistribution d = distribution_of(pressures, 1.0, width);
  if (d.n_outside > 0)
    remarks.warn(file, outside_bins(d, "particle pressures", "--pressure-bin-width"),
                 static_cast<double>(d.n_outside));
  for (int b = 0; b < static_cast<int>(d.counts.size()); ++b)
    table.rows.push_back(
        {file, size_or_none(unit), d.low(b), d.low(b + 1), d.counts[b], d.n, d.density(b), d.n_outside});
}

void add_phase_tables(const std::string& file, const PhaseStructure& phases, BondTables& tables) {
  for (const auto& [name, phase] :
       {std::pair{std::string("positive"), &phases.positive}, {std::string("negative"), &phases.negative}}) {
    for (const LikeNeighbourBin& bin : phase->by_share)
      if (bin.n_grains > 0)
        tables.neighbours.rows.push_back({file, name, bin.low, bin.high, count(bin.n_grains), bin.mean_size,
                                          bin.n_grains > 1 ? TableValue{bin.mean_error} : TableValue{}});
    std::map<int, int, std::greater<>> n_of_size;
    for (const int size : phase->cluster_sizes) ++n_of_size[size];
    for (const auto& [size, n] : n_of_size) tables.clusters.rows.push_back({file, name, count(size), count(n)});
  }
}

/// Returns a text with the lattice vectors along which a phase winds around the periodic cell, such as "xy", "z" or
/// "none". There are two phases: the grains with positive pressure and the grains with negative pressure.
std::string axes_of(const PhaseGeometry& phase) {
  std::string axes;
  for (int a = 0; a < 3; ++a)
    if (phase.along[a]) axes += "xyz"[a];
  return axes.empty() ? "none" : axes;
}

int largest_of(const PhaseGeometry& phase) {
  return phase.cluster_sizes.empty() ? 0 : phase.cluster_sizes.front();
}

void append_phase(const std::string& name, PhaseGeometry PhaseStructure::*phase,
                  std::vector<Column<BondRow>>& columns) {
  const auto add = [&](const std::string& what, auto value) {
    columns.emplace_back(name + what, [phase, value](const BondRow& r) {
      return r.phases ? TableValue{value(*r.phases.*phase)} : TableValue{};
    });
  };
  add("_along", [](const PhaseGeometry& p) { return axes_of(p); });
  add("_clusters",
      [](const PhaseGeometry& p) { return count(static_cast<std::int64_t>(p.cluster_sizes.size())); });
  add("_largest_cluster", [](const PhaseGeometry& p) { return count(largest_of(p)); });
  add("_largest_cluster_shuffled", [](const PhaseGeometry& p) { return p.largest_shuffled; });
  add("_directions", [](const PhaseGeometry& p) { return count(p.n_directions); });
  add("_directions_shuffled", [](const PhaseGeometry& p) { return p.shuffled_directions; });
  add("_percolates_shuffled", [](const PhaseGeometry& p) { return p.shuffled_percolates; });
}

}  // namespace

template <int Dim>
BondRow bond_row(const std::string& file, const Packing<Dim>& packing, const std::vector<double>& pressure,
                 const ForceLimits& limits, const BondTableOptions& options, BondTables& tables,
                 const Remarks& remarks) {
  BondRow row;
  if (options.is_empty() || packing.grains.size() == 0) return row;
  const double d = mean_diameter(packing.grains.radius), phi = solid_fraction(packing);
  const double F0 = pull_off_force(packing);
  row.bonds = bond_signs(packing, options.near * F0);
  row.virial_strength = virial_strength(Dim, row.bonds.z, phi, F0, d);
  row.rumpf_strength = rumpf_strength(Dim, phi, F0, d);
  row.unit_pressure = F0 > 0.0 ? F0 / std::pow(d, Dim - 1) : static_stress(packing).trace() / Dim;
  if (!options.needs_phases() && !options.needs_values()) return row;
  const std::vector<bool> rattler = find_rattlers(packing, limits.zero);
  if (options.needs_phases()) {
    row.phases =
        phase_structure(contact_network(packing), packing.cell,
                        pressure_beyond_zero(packing, pressure, rattler, limits.zero), options.phase_structure);
    add_phase_tables(file, *row.phases, tables);
  }
  if (!options.needs_values()) return row;
  std::vector<double> held;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (!rattler[i]) held.push_back(pressure[i]);
  for (const Measured& m : measured(packing, held, row.unit_pressure, limits, options)) {
    if (options.exponents) add_exponents(file, m, tables.exponents);
    if (m.unit == "p0" && options.pressures)
      add_histogram(file, m.values, m.unit_size, options.bin_width, tables.pressures, remarks);
    auto& pool = tables.pooled[{m.quantity, m.unit}];
    pool.insert(pool.end(), m.values.begin(), m.values.end());
  }
  return row;
}

std::vector<Column<BondRow>> bond_columns(const BondTableOptions& options) {
  using Row = BondRow;
  std::vector<Column<Row>> columns;
  if (options.bonds)
    columns = {{"n_bonds", [](const Row& r) { return count(r.bonds.n_bonds); }},
               {"z_bonds", [](const Row& r) { return r.bonds.z; }},
               {"z_bonds_plus", [](const Row& r) { return r.bonds.z_plus; }},
               {"z_bonds_minus", [](const Row& r) { return r.bonds.z_minus; }},
               {"z_bonds_near_zero", [](const Row& r) { return r.bonds.z_near; }},
               {"minus_share", [](const Row& r) { return r.bonds.minus_share; }},
               {"mean_plus", [](const Row& r) { return r.bonds.mean_plus; }},
               {"mean_minus", [](const Row& r) { return r.bonds.mean_minus; }},
               {"virial_strength", [](const Row& r) { return r.virial_strength; }},
               {"rumpf_strength", [](const Row& r) { return r.rumpf_strength; }}};
  if (!options.phases) return columns;
  const auto add = [&](const char* name, auto value) {
    columns.emplace_back(
        name, [value](const Row& r) { return r.phases ? TableValue{value(*r.phases)} : TableValue{}; });
  };
  // The particle pressures are given in units of p0. Their signs define the phases.
  columns.emplace_back("p0", [](const Row& r) { return r.unit_pressure; });
  add("n_signed_bonds", [](const PhaseStructure& p) { return count(p.n_bonds); });
  add("like_share", [](const PhaseStructure& p) { return p.like_share; });
  add("like_share_shuffled", [](const PhaseStructure& p) { return p.like_expected; });
  add("like_share_shuffled_stddev", [](const PhaseStructure& p) { return p.like_deviation; });
  append_phase("positive", &PhaseStructure::positive, columns);
  append_phase("negative", &PhaseStructure::negative, columns);
  return columns;
}

void add_pooled(const BondTableOptions& options, std::size_t n_states, BondTables& tables,
                const Remarks& remarks) {
  if (n_states < 2) return;
  for (const auto& [key, values] : tables.pooled) {
    const auto& [quantity, unit] = key;
    Measured m = limits_of(quantity, unit, options.near, kEnd);
    m.values = values;
    if (quantity == "force" && unit == "F0") m.end_of_negative = 1.0;
    add_exponents("pooled", m, tables.exponents);
    if (unit == "p0") add_histogram("pooled", values, 0.0, options.bin_width, tables.pressures, remarks);
  }
}

template BondRow bond_row(const std::string&, const Packing<2>&, const std::vector<double>&, const ForceLimits&,
                          const BondTableOptions&, BondTables&, const Remarks&);
template BondRow bond_row(const std::string&, const Packing<3>&, const std::vector<double>&, const ForceLimits&,
                          const BondTableOptions&, BondTables&, const Remarks&);

}  // namespace floc
