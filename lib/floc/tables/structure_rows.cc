#include "floc/tables/structure_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "floc/base/error.h"
#include "floc/base/processor_seconds.h"
#include "floc/network/rattlers.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/require_elastic.h"
#include "floc/packing/require_periodic.h"
#include "floc/structure/axis_profile.h"
#include "floc/structure/coordination.h"
#include "floc/structure/coverage.h"
#include "floc/structure/gap_coordination.h"
#include "floc/structure/pair_correlation.h"
#include "floc/structure/particle_stress.h"
#include "floc/structure/pores.h"
#include "floc/structure/porosity_probe.h"
#include "floc/structure/pushed_rattlers.h"
#include "floc/structure/voronoi.h"
#include "floc/tables/column.h"

namespace floc {
namespace {

ScatteringFit fit_of(const Scattering& s, const StructureTableOptions& options, double diameter) {
  std::vector<ScatteredPoint> points;
  for (std::size_t b = 0; b < s.k.size(); ++b) points.push_back({s.k[b], s.I[b], s.n_vectors[b]});
  const double unit = 2.0 * std::numbers::pi / diameter;
  return fit_scattering(points, options.fit_range[0] * unit, options.fit_range[1] * unit);
}

/// Adds the scattered intensity I(k) of a state to the table of intensities. Warns if the law of fractal aggregates
/// could not be fitted to I(k), or if the fit did not identify one of its parameters.
void report(const std::string& file, const Scattering& s, const ScatteringFit& fit, Table& table,
            const Remarks& remarks) {
  if (!fit.found())
    remarks.remark(file, "no law could be fitted to the scattered intensity I(k): " + fit.failure_reason);
  for (const std::string& warning : fit.warnings) remarks.warn(file, warning, first_number(warning));
  const bool drawn = fit.found() && std::all_of(fit.parameters.begin(), fit.parameters.end(),
                                                [](const FittedParameter& p) { return p.value.has_value(); });
  for (std::size_t b = 0; b < s.k.size(); ++b) {
    const bool used = drawn && s.k[b] >= fit.low && s.k[b] <= fit.high;
    table.rows.push_back(
        {file, s.k[b], s.I[b], s.n_vectors[b],
         used ? TableValue{scattered_intensity(*fit.parameters[0].value, *fit.parameters[1].value,
                                               *fit.parameters[2].value, s.k[b])}
              : TableValue{}});
  }
}

/// Fits the law of fractal aggregates to the scattered intensity I(k) of a state, and adds the rows of the state to the
/// table of intensities.
/// @param diameter  largest diameter of the grains (length)
void add_fit(const Scattering& s, double diameter, const StructureTableOptions& options, Series& series,
             StructureRow& row, const Remarks& remarks) {
  row.fit = fit_of(s, options, diameter);
  report(row.file, s, *row.fit, series.intensity, remarks);
}

/// Returns the object in `series` that averages the scattered intensity over all states. The first call creates the
/// object.
/// @param edges     edges of the bins of wave number; the edges of the first call are used for all states
/// @param diameter  largest diameter in the first state (length)
ScatteringAverage& average_in(Series& series, const std::vector<double>& edges, double diameter) {
  if (!series.average) {
    series.diameter = diameter;
    series.average.emplace(edges);
  }
  return *series.average;
}

void add_scattering(const Packing<2>& packing, const StructureTableOptions& options, Series& series,
                    StructureRow& row, const Remarks& remarks) {
  const ScatteringMesh mesh = scattering_mesh(packing, options.scattering);
  const Packing<2> shortest = in_shortest_cell(packing);
  const double diameter = largest_diameter(packing.grains);
  row.mesh_spacing = mesh.spacing;
  row.mesh = mesh.size(shortest.cell);
  const CoverageMap coverage = coverage_map(shortest, row.mesh);
  ScatteringAverage alone(mesh.edges);
  alone.add(shortest.cell, coverage);
  add_fit(alone.result(), diameter, options, series, row, remarks);
  if (!options.average) return;
  if (!series.average) series.mean.mesh_spacing = mesh.spacing;
  average_in(series, mesh.edges, diameter).add(shortest.cell, coverage);
}

void add_scattering(const Packing<3>& packing, const StructureTableOptions& options, Series& series,
                    StructureRow& row, const Remarks& remarks) {
  const double diameter = largest_diameter(packing.grains);
  const std::vector<double> edges = scattering_edges(packing, options.scattering);
  ScatteringAverage alone(edges);
  alone.add(packing, options.scattering.most_vectors);
  add_fit(alone.result(), diameter, options, series, row, remarks);
  if (options.average) average_in(series, edges, diameter).add(packing, options.scattering.most_vectors);
}

/// If a table has no rows yet, sets its columns to `names`, which depend on the dimension of the state. Otherwise
/// checks that its columns are `names`.
void choose_columns(const std::string& file, const std::vector<std::string>& names, Table& table) {
  if (table.rows.empty()) table.columns.clear();
  expect_columns(file, names, table);
}

void add_pores(const Packing<2>& packing, const StructureTableOptions& options, Series& series,
               StructureRow& row, const Remarks& remarks) {
  const Pores pores = find_pores(packing);
  if (!pores.failure_reason.empty()) {
    remarks.warn(row.file, pores.failure_reason);
    return;
  }
  row.n_pores = static_cast<std::int64_t>(pores.pores.size());
  row.unbounded = pores.unbounded;
  if (pores.unbounded)
    remarks.warn(row.file,
                 "one pore of this state winds around the periodic cell, so it has no size and is left out");
  if (!pores.pores.empty()) row.pore_size = pores.size, row.pore_mean_area = pores.mean_area;
  if (options.pores) {
    choose_columns(row.file, kPoreColumns, series.pores);
    for (const Pore& p : pores.pores)
      series.pores.rows.push_back(
          {row.file, p.centre[0], p.centre[1], p.area, p.gyration_radius,
           static_cast<std::int64_t>(std::set(p.grains.begin(), p.grains.end()).size())});
  }
  series.pore_area += pores.total_area;
  series.pore_second_moment += pores.total_area * pores.size * pores.size;
  series.mean.n_pores = series.mean.n_pores.value_or(0) + *row.n_pores;
}

void require_map_size(const std::vector<int>& size) {
  for (const int side : size) require_in_range("map_size", side, kMapSide);
  if (!kMapCells.holds(std::int64_t{size[0]} * size[1]))
    throw InputError("", fmt::format("map_size = {},{}: expected at most {} mesh cells in the whole map",
                                     size[0], size[1], kMapCells.most));
}

void add_map(const std::string& file, const Packing<2>& packing, const StructureTableOptions& options,
             Table& table) {
  choose_columns(file, kMapColumns, table);
  require_map_size(options.map_size);
  const CoverageMap map = coverage_map(packing, {options.map_size[0], options.map_size[1]});
  for (int k1 = 0; k1 < map.size[0]; ++k1)
    for (int k2 = 0; k2 < map.size[1]; ++k2) {
      const Vec<2> middle((k1 + 0.5) / map.size[0], (k2 + 0.5) / map.size[1]);
      const Vec<2> x = packing.cell.matrix.transpose() * middle;
      table.rows.push_back({file, count(k1), count(k2), x[0], x[1], map(k1, k2)});
    }
}

LocalStructure local_structure(const VoronoiTessellation& voronoi) {
  LocalStructure out;
  const auto n = static_cast<double>(voronoi.solid_fraction.size());
  for (const double phi : voronoi.solid_fraction) out.mean += phi / n;
  for (const double phi : voronoi.solid_fraction) out.deviation += (phi - out.mean) * (phi - out.mean) / n;
  out.deviation = std::sqrt(out.deviation);
  out.n_voids = static_cast<std::int64_t>(voronoi.voids.size());
  for (const VoidBall& ball : voronoi.voids) {
    out.mean_void += ball.radius / static_cast<double>(out.n_voids);
    out.largest_void = std::max(out.largest_void, ball.radius);
  }
  return out;
}

void add_voronoi(const Packing<3>& packing, const StructureTableOptions& options, Series& series,
                 StructureRow& row) {
  const VoronoiTessellation voronoi = voronoi_tessellation(packing);
  row.local = local_structure(voronoi);
  if (options.pores) {
    choose_columns(row.file, {"file", "x1", "x2", "x3", "radius"}, series.pores);
    for (const VoidBall& ball : voronoi.voids)
      series.pores.rows.push_back({row.file, ball.centre[0], ball.centre[1], ball.centre[2], ball.radius});
  }
  if (!options.map) return;
  choose_columns(row.file, {"file", "grain", "x1", "x2", "x3", "voronoi_volume", "solid_fraction"}, series.map);
  for (int i = 0; i < packing.grains.size(); ++i) {
    const Vec<3>& x = packing.grains.position[i];
    series.map.rows.push_back(
        {row.file, packing.grains.name(i), x[0], x[1], x[2], voronoi.volume[i], voronoi.solid_fraction[i]});
  }
}

/// Returns the factor by which the lengths in a packing are multiplied to compare the packing with the first packing:
/// (Phi/Phi0)^(1/Dim), where Phi is the solid fraction of the packing and Phi0 that of the first packing.
template <int Dim>
double rescaling(const Packing<Dim>& packing, const Series& series) {
  return std::pow(solid_fraction(packing) / *series.reference_phi, 1.0 / Dim);
}

template <int Dim>
void add_pairs(const std::string& file, const Packing<Dim>& packing, const StructureTableOptions& options,
               Series& series) {
  constexpr double kBinsPerDiameter = 50.0;
  require_in_range("reach", options.reach, kPairReach);
  const double reach = options.reach * largest_diameter(packing.grains);
  const PairCorrelation found =
      pair_correlation(packing, reach, static_cast<int>(std::ceil(options.reach * kBinsPerDiameter)));
  const double scale = rescaling(packing, series);
  for (int b = 0; b < static_cast<int>(found.g.size()); ++b)
    series.pairs.rows.push_back({file, found.middle(b),
                                 std::isfinite(found.g[b]) ? TableValue(found.g[b]) : TableValue(),
                                 found.n_pairs[b], scale * found.middle(b)});
}

/// Returns the gaps h (length) up to which the neighbours of a grain are counted: 0, and ten values per decade from
/// 1e-6 to 1 times the largest diameter.
std::vector<double> gaps_of(double diameter) {
  std::vector<double> gaps = {0.0};
  for (int k = -60; k <= 0; ++k) gaps.push_back(diameter * std::pow(10.0, 0.1 * k));
  return gaps;
}

/// For each grain, returns whether it is a rattler. Forces below the tolerance of equilibrium of the state count as
/// zero.
template <int Dim>
std::vector<bool> rattlers_of(const State<Dim>& state) {
  return find_rattlers(state.packing,
                       state.tolerance.force * force_scale(state.packing, state.target_stress).force);
}

template <int Dim>
void add_gaps(const std::string& file, const State<Dim>& state, Series& series) {
  const Packing<Dim>& packing = state.packing;
  const double a = largest_diameter(packing.grains);
  const std::vector<double> gaps = gaps_of(a);
  const std::vector<double> z = gap_coordination(packing, gaps);
  const std::vector<double> pushed = gap_coordination(with_pushed_rattlers(packing, rattlers_of(state)), gaps);
  const double scale = rescaling(packing, series);
  for (std::size_t k = 0; k < gaps.size(); ++k)
    series.gaps.rows.push_back({file, gaps[k], z[k], pushed[k], scale * (a + gaps[k]) - a});
}

/// Returns the void ratio 1/Phi - 1 for a solid fraction Phi. The cell is empty if Phi is zero.
TableValue void_ratio(double solid_fraction) {
  return solid_fraction > 0.0 ? TableValue{1.0 / solid_fraction - 1.0} : TableValue{};
}

template <int Dim>
void add_porosity(const std::string& file, const Packing<Dim>& packing, const StructureTableOptions& options,
                  Table& table) {
  for (const PorosityProbe& probe : porosity_probes(packing, options.n_probes))
    table.rows.push_back({file, probe.half_side, void_ratio(probe.in_cube), 1.0 - probe.in_cube,
                          probe.in_cell ? void_ratio(*probe.in_cell) : TableValue{},
                          probe.in_cell ? TableValue{1.0 - *probe.in_cell} : TableValue{}});
}

/// Returns the number of contacts of each grain, including contacts with walls. Attraction across a gap does not count
/// as a contact.
template <int Dim>
std::vector<double> contacts_of_each(const Packing<Dim>& packing) {
  std::vector<double> n(packing.grains.size(), 0.0);
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.distant) continue;
    ++n[c.i];
    if (!packing.is_wall(c.j)) ++n[c.j];
  }
  return n;
}

template <int Dim>
void add_profile(const std::string& file, const Packing<Dim>& packing, const StructureTableOptions& options,
                 Table& table) {
  const int axis = options.profile_axis.value_or(Dim - 1);
  if (axis >= Dim) throw InputError(file, "this state is in 2D and has no axis z: give --profile-axis x or y");
  const std::vector<std::vector<double>> values = {contacts_of_each(packing), particle_pressure(packing)};
  for (const ProfileSlice& s : axis_profile(packing, axis, options.n_slices, values)) {
    std::vector<TableValue> row = {
        file, s.low, s.high, s.solid_fraction, void_ratio(s.solid_fraction), count(s.n_grains), s.mean[0]};
    // cells remain empty for quantities that are not defined for this packing
    row.resize(table.columns.size());
    if (s.mean.size() > 1) row[7] = s.mean[1];
    for (std::size_t a = 0; a < s.stress.size(); ++a) row[8 + a] = s.stress[a];
    table.rows.push_back(std::move(row));
  }
}

template <int Dim>
void add_prediction(const std::string& file, const State<Dim>& state, Series& series) {
  if (std::holds_alternative<std::monostate>(series.affine))
    series.affine = AffineReference<Dim>(state.packing, rattlers_of(state));
  const auto* reference = std::get_if<AffineReference<Dim>>(&series.affine);
  if (reference == nullptr)
    throw InputError(file,
                     "this state differs in dimension from the first state, from which its pressure and "
                     "coordination are predicted");
  const double phi = solid_fraction(state.packing);
  const AffinePrediction p = reference->at(phi);
  series.prediction.rows.push_back({series.reference, file, phi, static_stress(state.packing).trace() / Dim,
                                    coordination(state.packing, 0.0).z, p.pressure, p.z, p.z_pushed});
}

/// Adds the scattered intensity, the pores, the map and the Voronoi cells. They can be computed only in a periodic cell
/// without walls, because they need the periodic images of the grains.
template <int Dim>
void add_periodic_structure(const Packing<Dim>& packing, const StructureTableOptions& options, Series& series,
                            StructureRow& row, const Remarks& remarks) {
  add_scattering(packing, options, series, row, remarks);
  if constexpr (Dim == 2) {
    add_pores(packing, options, series, row, remarks);
    if (options.map) add_map(row.file, packing, options, series.map);
  } else {
    add_voronoi(packing, options, series, row);
  }
}

/// If the state has walls, checks that the options select no table that needs the periodic images of the grains.
/// @throws InputError with the name of the first selected table that needs them
template <int Dim>
void refuse_periodic_tables(const Packing<Dim>& packing, const StructureTableOptions& options,
                            const std::string& file) {
  for (const auto& [table, asked] :
       {std::pair{"the scattering intensity I(k) is computed", options.intensity},
        {"the numbers z(h) of neighbours within a gap h are computed", options.gaps},
        {"pores are computed", options.pores},
        {"a map of the solid fraction is computed", options.map},
        {"the affine prediction is computed", options.prediction}})
    if (asked) require_periodic(packing, table, file);
  if (options.average) require_periodic(packing, "an average over states is computed", file);
}

/// If the grains have corners, checks that the options select no table that can be computed only for disks or spheres.
/// @throws InputError with the name of the first selected table that needs them
template <int Dim>
void refuse_round_tables(const Packing<Dim>& packing, const StructureTableOptions& options,
                         const std::string& file) {
  for (const auto& [table, asked] :
       {std::pair{"the scattering intensity I(k) is computed", options.intensity},
        {"the numbers z(h) of neighbours within a gap h are computed", options.gaps},
        {"pores are computed", options.pores},
        {"a map of the solid fraction is computed", options.map},
        {"the affine prediction is computed", options.prediction},
        {"the porosity about the centre is computed", options.porosity},
        {"profiles are computed", options.profile},
        {"an average over states is computed", options.average}})
    if (asked) require_round(packing, table, file);
}

}  // namespace

std::vector<std::string> StructureTableOptions::validate() const {
  std::vector<std::string> faults;
  if (fit_range.size() != 2 || !(fit_range[0] < fit_range[1]))
    faults.push_back("fit-range: expected LOW,HIGH with LOW < HIGH");
  return faults;
}

template <int Dim>
StructureRow structure_row(const std::string& file, const State<Dim>& state,
                           const StructureTableOptions& options, Series& series, const Remarks& remarks) {
  const double start = processor_seconds();
  const Packing<Dim>& packing = state.packing;
  if (series.dimension == 0) series.dimension = Dim;
  if (options.average && series.dimension != Dim)
    throw InputError(file,
                     "this state differs in dimension from the states before it, but an average can only "
                     "contain states of one dimension");
  StructureRow row;
  row.file = file;
  row.dimension = Dim;
  row.n_grains = packing.grains.size();
  row.reduced_pressure = reduced_pressure(packing, static_stress(packing).trace() / Dim);
  row.reduced_driven_stress =
      reduced_pressure(packing, stress_on_driven_axis<Dim>(state, static_stress(packing).diagonal()));
  row.solid_fraction = solid_fraction(packing);
  if (!packing.walls.empty()) refuse_periodic_tables(packing, options, file);
  refuse_round_tables(packing, options, file);
  if (packing.walls.empty() && packing.grains.are_round())
    add_periodic_structure(packing, options, series, row, remarks);
  if (!series.reference_phi) series.reference = file, series.reference_phi = row.solid_fraction;
  if (options.pairs) add_pairs(file, packing, options, series);
  if (options.gaps) add_gaps(file, state, series);
  if (options.prediction) add_prediction(file, state, series);
  if (options.porosity) add_porosity(file, packing, options, series.porosity);
  if (options.profile) add_profile(file, packing, options, series.profile);
  row.seconds = processor_seconds() - start;
  return row;
}

StructureRow averaged(const std::vector<StructureRow>& rows, const StructureTableOptions& options,
                      Series& series, const Remarks& remarks) {
  StructureRow mean = series.mean;
  mean.file = "average";
  const auto n = static_cast<double>(rows.size());
  for (const StructureRow& row : rows) {
    mean.dimension = row.dimension;
    mean.n_grains += row.n_grains;
    mean.reduced_pressure += row.reduced_pressure / n;
    mean.reduced_driven_stress += row.reduced_driven_stress / n;
    mean.solid_fraction += row.solid_fraction / n;
    mean.unbounded = mean.unbounded || row.unbounded;
    mean.seconds += row.seconds;
  }
  const Scattering s = series.average->result();
  mean.fit = fit_of(s, options, series.diameter);
  report(mean.file, s, *mean.fit, series.intensity, remarks);
  if (series.pore_area > 0.0) {
    mean.pore_size = std::sqrt(series.pore_second_moment / series.pore_area);
    mean.pore_mean_area = series.pore_area / static_cast<double>(*mean.n_pores);
  }
  return mean;
}

template StructureRow structure_row(const std::string&, const State<2>&, const StructureTableOptions&, Series&,
                                    const Remarks&);
template StructureRow structure_row(const std::string&, const State<3>&, const StructureTableOptions&, Series&,
                                    const Remarks&);

}  // namespace floc
