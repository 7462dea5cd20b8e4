#include "floc/tables/size_rows.h"

#include <algorithm>
#include <optional>
#include <string>
#include <variant>

#include "floc/scene/read_scene.h"
#include "floc/tables/column.h"

namespace floc {
namespace {

std::vector<Column<SizeClass>> size_columns() {
  return {{"d_from", [](const SizeClass& c) { return c.from; }},
          {"d_to", [](const SizeClass& c) { return c.to; }},
          {"n_grains", [](const SizeClass& c) { return count(c.n_grains); }},
          {"share", [](const SizeClass& c) { return c.share; }},
          {"share_asked", [](const SizeClass& c) { return or_undefined(c.share_asked); }},
          {"passing", [](const SizeClass& c) { return c.passing; }},
          {"passing_asked", [](const SizeClass& c) { return or_undefined(c.passing_asked); }}};
}

/// Returns the size distribution in the text of a scene or, if the text cannot be read, a distribution that consists of
/// the given diameters.
/// @param file  name of the state file that contains the text
/// @param diameters  diameters of the grains of the state (length)
DiameterDistribution distribution_of(const std::string& file, const std::string& scene,
                                     const std::vector<double>& diameters) {
  // The scene may start from a saved state whose file no longer exists.
  std::string why_not;
  if (!scene.empty())
    if (const std::optional<Scene> read = scene_of_state(scene, file, why_not)) return read->grains.diameter;
  DiameterDistribution list;
  list.kind = DiameterDistribution::Kind::list;
  list.values = diameters;
  const auto [smallest, largest] = std::ranges::minmax(diameters);
  list.min = smallest;
  list.max = largest;
  return list;
}

}  // namespace

Table size_table(const std::vector<SizeClass>& classes) {
  return to_table(size_columns(), classes);
}

void add_size_rows(const std::string& file, const AnyState& any, Table& table) {
  std::visit(
      [&]<int Dim>(const State<Dim>& state) {
        std::vector<double> diameters = state.packing.grains.radius;
        for (double& d : diameters) d *= 2.0;
        const Table rows =
            size_table(size_classes(distribution_of(file, state.scene, diameters), diameters, Dim));
        table.columns = rows.columns;
        table.columns.insert(table.columns.begin(), "file");
        for (std::vector<TableValue> row : rows.rows) {
          row.insert(row.begin(), file);
          table.rows.push_back(std::move(row));
        }
      },
      any);
}

}  // namespace floc
