#include "floc/tables/state_moduli.h"

#include <fmt/format.h>

#include <filesystem>

#include "floc/base/error.h"
#include "floc/elasticity/moduli.h"
#include "floc/io/state_file.h"
#include "floc/packing/require_elastic.h"

namespace floc {

StateModuli moduli_of(const std::string& file, int axis) {
  const AnyState any = read_state(file);
  return std::visit(
      [&]<int Dim>(const State<Dim>& state) {
        require_elastic(state.packing, "moduli are computed", file);
        const Moduli m = elastic_moduli(state.packing, ModuliOptions{});
        const char* unit = state.units != "SI" ? "" : Dim == 2 ? "N/m" : "Pa";
        StateModuli moduli{file, unit, m.B, m.B_S, state.target_stress.mean(), solid_fraction(state.packing)};
        if (axis >= Dim)
          throw InputError(
              file,
              fmt::format(
                  "this state has {} axes, but the oedometer test drives axis {}: give a state of this test",
                  Dim, axis + 1));
        if (axis < 0) return moduli;
        moduli.M = m.C(axis, axis);
        moduli.B_uniaxial = m.C.col(axis).head(Dim).mean();
        return moduli;
      },
      any);
}

StateModuli in_unit_of(const PathTable& path, StateModuli moduli) {
  if (path.unit.empty()) return moduli;
  const double factor = unit_factor(moduli.file, moduli.unit, path.name, path.unit);
  for (double* stress : {&moduli.B, &moduli.B_S, &moduli.pressure}) *stress *= factor;
  for (std::optional<double>* stress : {&moduli.M, &moduli.B_uniaxial})
    if (*stress) **stress *= factor;
  moduli.unit = path.unit;
  return moduli;
}

int driven_axis(const PathTable& path, int row) {
  if (path.rows[static_cast<std::size_t>(row)].load != PathLoad::oedometric) return -1;
  return static_cast<int>(path.table.integer(row, path.table.column("axis"))) - 1;
}

std::optional<StateModuli> moduli_of_row(const PathTable& path, int row, int axis) {
  if (!path.table.has("state") || path.name == "stdin") return std::nullopt;
  const auto file =
      std::filesystem::path(path.name).parent_path() / path.table.text(row, path.table.column("state"));
  return std::filesystem::is_regular_file(file) ? std::optional(moduli_of(file.string(), axis)) : std::nullopt;
}

}  // namespace floc
