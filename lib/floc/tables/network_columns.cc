#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/tables/network_rows.h"

namespace floc {
namespace {

/// Returns a function that computes a cell from a row: the integer `number` in the optional member `part` of the row.
/// The cell is empty if `part` is absent.
template <class Part>
auto count_of(std::optional<Part> NetworkRow::*part, int Part::*number) {
  return [=](const NetworkRow& r) { return r.*part ? count((*(r.*part)).*number) : TableValue{}; };
}

/// Returns a function that computes a cell from a row: the member `number` of the network mechanics. The cell is empty
/// if the network mechanics or this member are absent.
auto number_of(std::optional<double> NetworkMechanics::*number) {
  return [=](const NetworkRow& r) { return r.mechanics ? or_undefined((*r.mechanics).*number) : TableValue{}; };
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
      {"hyperstaticity", count_of(&Row::hyperstaticity, &Indeterminacy::degree)},
      {"n_null_modes", count_of(&Row::hyperstaticity, &Indeterminacy::n_null_modes)},
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
  // Tables of disks also have the columns of axis 3, with empty cells, so that a table can contain states in 2D and
  // states in 3D.
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
  using Mechanics = NetworkMechanics;
  return {{"indeterminacy",
           [](const Row& r) {
             if (r.rigid_indeterminacy) return count(r.rigid_indeterminacy->degree);
             return r.mechanics ? count(r.mechanics->indeterminacy.degree) : TableValue{};
           }},
          {"n_dead_ends", count_of(&Row::mechanics, &Mechanics::n_dead_ends)},
          {"n_components", count_of(&Row::mechanics, &Mechanics::n_components)},
          {"n_percolating", count_of(&Row::mechanics, &Mechanics::n_percolating)},
          {"energy_share_95", number_of(&Mechanics::energy_share_95)},
          {"energy_share_95_deviatoric", number_of(&Mechanics::energy_share_95_deviatoric)},
          {"backbone_share", number_of(&Mechanics::backbone_share)},
          {"scalar_backbone_share", number_of(&Mechanics::scalar_backbone_share)},
          {"correlation_normal", [](const Row& r) { return or_undefined(r.correlation.normal); }},
          {"correlation_size", [](const Row& r) { return or_undefined(r.correlation.size); }},
          {"seconds", [](const Row& r) { return r.seconds; }},
          {"units", [](const Row& r) { return r.units; }}};
}

/// Returns the columns about the kinds of contacts (vertex, edge, face) between grains with corners. For round grains,
/// the cells of these columns are empty.
std::vector<Column<NetworkRow>> kind_columns() {
  using Row = NetworkRow;
  std::vector<Column<Row>> columns = {
      {"z_pairs_star", [](const Row& r) { return r.kinds ? TableValue{r.kinds->z} : TableValue{}; }}};
  constexpr const char* kKinds[] = {"vertex_face", "edge_edge", "edge_face", "face_face"};
  for (const auto& [name, part] :
       {std::pair{"pairs", &ContactKinds::share}, std::pair{"force", &ContactKinds::force}})
    for (std::size_t k = 0; k < std::size(kKinds); ++k)
      columns.emplace_back(fmt::format("{}_{}", name, kKinds[k]), [k, part = part](const Row& r) {
        return r.kinds ? TableValue{((*r.kinds).*part)[k]} : TableValue{};
      });
  return columns;
}

std::vector<Column<NetworkRow>> anisotropy_columns() {
  std::vector<Column<NetworkRow>> columns;
  for (const auto& [name, number] : {std::pair{"a_normals", &ContactAnisotropy::normals},
                                     std::pair{"a_normal_force", &ContactAnisotropy::normal_force},
                                     std::pair{"a_tangential_force", &ContactAnisotropy::tangential_force},
                                     std::pair{"a_branch_normal", &ContactAnisotropy::branch_normal},
                                     std::pair{"a_branch_tangential", &ContactAnisotropy::branch_tangential},
                                     std::pair{"stress_ratio", &ContactAnisotropy::stress_ratio},
                                     std::pair{"stress_ratio_predicted", &ContactAnisotropy::predicted_ratio}})
    columns.emplace_back(name, [number = number](const NetworkRow& r) {
      return r.anisotropy ? TableValue{(*r.anisotropy).*number} : TableValue{};
    });
  return columns;
}

/// Returns the name of a column about the distribution of forces. If `by_pairs` is true (forces between pairs of
/// grains), "_pairs" is inserted: alpha becomes alpha_pairs, and alpha_error becomes alpha_pairs_error.
std::string with_pairs(const std::string& name, bool by_pairs) {
  if (!by_pairs) return name;
  const std::size_t at = name.find("_error");
  return at == std::string::npos ? name + "_pairs" : name.substr(0, at) + "_pairs_error";
}

/// Adds columns about the distribution of forces, counted by contact points or by pairs of grains.
void add_force_shape(bool by_pairs,
                     const std::vector<std::pair<std::string, std::optional<double> ForceShape::*>>& numbers,
                     std::vector<Column<NetworkRow>>& columns) {
  for (const auto& [name, number] : numbers)
    columns.emplace_back(with_pairs(name, by_pairs), [by_pairs, number = number](const NetworkRow& r) {
      if (by_pairs) return r.force_by_pairs ? or_undefined((*r.force_by_pairs).*number) : TableValue{};
      return or_undefined(r.force_by_points.*number);
    });
}

/// Returns two sets of columns: columns about the distribution of forces (first counted by contact points, second by
/// pairs of grains), and columns about the long axes of grains.
std::vector<Column<NetworkRow>> force_shape_columns() {
  using Row = NetworkRow;
  std::vector<Column<Row>> columns;
  for (const bool by_pairs : {false, true}) {
    columns.emplace_back(with_pairs("below_mean", by_pairs), [by_pairs](const Row& r) {
      if (by_pairs) return r.force_by_pairs ? TableValue{r.force_by_pairs->below_mean} : TableValue{};
      return TableValue{r.force_by_points.below_mean};
    });
    add_force_shape(by_pairs,
                    {{"alpha", &ForceShape::alpha},
                     {"alpha_error", &ForceShape::alpha_error},
                     {"beta", &ForceShape::beta},
                     {"beta_error", &ForceShape::beta_error}},
                    columns);
  }
  columns.emplace_back("mobilisation", [](const Row& r) { return or_undefined(r.mobilisation); });
  columns.emplace_back("long_axes_order", [](const Row& r) { return or_undefined(r.long_axes_order); });
  for (std::size_t a = 0; a < 3; ++a)
    columns.emplace_back(fmt::format("long_axis{}", a + 1), [a](const Row& r) {
      return a < r.long_axis.size() ? TableValue{r.long_axis[a]} : TableValue{};
    });
  for (const bool by_pairs : {false, true})
    add_force_shape(by_pairs, {{"beta2", &ForceShape::beta2}, {"beta2_error", &ForceShape::beta2_error}},
                    columns);
  return columns;
}

}  // namespace

std::vector<Column<NetworkRow>> network_columns(const NetworkTableOptions& options) {
  std::vector<Column<NetworkRow>> columns = counted_columns();
  for (const auto& more : {force_columns(), mechanics_columns(), carrying_columns()})
    columns.insert(columns.end(), more.begin(), more.end());
  for (const auto& [name, value] : bond_columns(options.bonds))
    columns.emplace_back(name, [value = value](const NetworkRow& r) { return value(r.bonds); });
  columns.emplace_back("p_wall", [](const NetworkRow& r) { return or_undefined(r.wall_pressure); });
  columns.emplace_back("P_driven", [](const NetworkRow& r) { return r.driven_stress; });
  columns.emplace_back("P_driven_star", [](const NetworkRow& r) { return r.reduced_driven_stress; });
  columns.emplace_back("n_solid_bonds", [](const NetworkRow& r) { return count(r.n_bonds); });
  for (const auto& more : {kind_columns(), anisotropy_columns(), force_shape_columns()})
    columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

}  // namespace floc
