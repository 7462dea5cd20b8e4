#include "floc/tables/info_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "floc/base/sha256.h"
#include "floc/io/law_text.h"
#include "floc/packing/balance.h"
#include "floc/packing/wall_forces.h"
#include "floc/structure/coordination.h"

namespace floc {
namespace {

struct Entry {
  const char* name;
  TableValue value;
};

template <int Dim>
std::string cell_text(const Cell<Dim>& cell) {
  std::vector<std::string> vectors;
  for (int a = 0; a < Dim; ++a)
    vectors.push_back(fmt::format("{}", fmt::join(cell.matrix.row(a).begin(), cell.matrix.row(a).end(), ",")));
  return fmt::format("{}", fmt::join(vectors, ";"));
}

template <int Dim>
void add_packing(const State<Dim>& state, std::vector<Entry>& entries) {
  const Packing<Dim>& packing = state.packing;
  const Coordination counted = coordination(packing, 0.0);
  const double pressure = static_stress(packing).diagonal().mean();
  const int n = packing.grains.size();
  entries.push_back({"dimension", std::int64_t{Dim}});
  entries.push_back({"units", state.units});
  entries.push_back({"n_grains", std::int64_t{n}});
  entries.push_back({"n_contacts", std::int64_t{counted.n_contacts}});
  entries.push_back({"n_distant", std::int64_t{counted.n_distant}});
  entries.push_back({"phi", solid_fraction(packing)});
  entries.push_back({"z", counted.z});
  entries.push_back({"P", pressure});
  entries.push_back({"P_star", reduced_pressure(packing, pressure)});
  entries.push_back(
      {"target", fmt::format("{}", fmt::join(state.target_stress.begin(), state.target_stress.end(), ","))});
  entries.push_back({"cell", cell_text(packing.cell)});
  entries.push_back({"law", law_text(packing.law)});
}

template <int Dim>
void add_history(const State<Dim>& state, std::vector<Entry>& entries) {
  entries.push_back({"residual_force", state.residuals.force});
  entries.push_back({"residual_moment", state.residuals.moment});
  entries.push_back({"residual_stress", state.residuals.stress});
  entries.push_back({"kinetic_energy", state.residuals.energy});
  entries.push_back(
      {"n_negative", state.n_negative < 0 ? TableValue{} : TableValue{std::int64_t{state.n_negative}}});
  entries.push_back({"step", std::int64_t{state.path.step}});
  entries.push_back({"branch", or_undefined(state.path.branch)});
  entries.push_back({"time", state.path.time});
  entries.push_back({"n_steps", state.path.n_steps});
  entries.push_back({"ending", or_undefined(state.path.ending)});
  entries.push_back({"program", or_undefined(state.provenance.program)});
  entries.push_back({"commit", or_undefined(state.provenance.commit)});
  entries.push_back({"compiler", or_undefined(state.provenance.compiler)});
  // The seed is written as text. A signed integer cell could overflow, and readers of json round integers of this size.
  entries.push_back({"seed", fmt::format("{}", state.provenance.seed)});
  entries.push_back({"source", or_undefined(state.provenance.source)});
  entries.push_back({"parent_sha256", or_undefined(state.provenance.parent_sha256)});
  entries.push_back({"scene_sha256", state.scene.empty() ? TableValue{} : TableValue{sha256(state.scene)}});
}

/// Adds entries about the shapes of grains: number of shapes, numbers of their faces (in 2D: sides), and rounding of
/// the shapes. The entries are empty for round grains.
template <int Dim>
void add_shapes(const Grains<Dim>& grains, std::vector<Entry>& entries) {
  std::optional<std::int64_t> n_shapes, least, most;
  std::optional<double> rounding;
  if (!grains.are_round()) {
    n_shapes = static_cast<std::int64_t>(grains.shapes->size());
    const auto [fewest, largest] = std::ranges::minmax(*grains.shapes, {}, &Shape<Dim>::n_faces);
    least = fewest.n_faces(), most = largest.n_faces();
    rounding = 0.0;
    for (const Shape<Dim>& s : *grains.shapes) rounding = std::max(*rounding, s.rounding / s.diameter());
  }
  const auto counted = [](const std::optional<std::int64_t>& n) { return n ? TableValue{*n} : TableValue{}; };
  entries.push_back({"n_shapes", counted(n_shapes)});
  entries.push_back({"least_faces", counted(least)});
  entries.push_back({"most_faces", counted(most)});
  entries.push_back({"rounding", or_undefined(rounding)});
}

template <int Dim>
void add_driven_stress(const State<Dim>& state, std::vector<Entry>& entries) {
  const double driven = stress_on_driven_axis<Dim>(state, static_stress(state.packing).diagonal());
  entries.push_back({"P_driven", driven});
  entries.push_back({"P_driven_star", reduced_pressure(state.packing, driven)});
}

}  // namespace

void add_info_row(const std::string& file, const AnyState& any, Table& table) {
  std::vector<Entry> entries = {{"file", file}};
  std::visit(
      [&](const auto& state) {
        add_packing(state, entries);
        add_history(state, entries);
      },
      any);
  entries.push_back({"sha256", sha256_of_file(file)});
  entries.push_back(
      {"p_wall",
       std::visit([](const auto& state) { return or_undefined(mean_wall_pressure(state.packing)); }, any)});
  std::visit([&](const auto& state) { add_shapes(state.packing.grains, entries); }, any);
  std::visit([&](const auto& state) { add_driven_stress(state, entries); }, any);
  if (table.columns.empty())
    for (const Entry& entry : entries) table.columns.emplace_back(entry.name);
  auto& row = table.rows.emplace_back();
  for (Entry& entry : entries) row.push_back(std::move(entry.value));
}

}  // namespace floc
