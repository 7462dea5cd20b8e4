#include "state_moduli.h"

#include <filesystem>

#include "floc/elasticity/moduli.h"
#include "floc/io/state_file.h"

namespace floc {

StateModuli moduli_of(const std::string& file) {
  const AnyState any = read_state(file);
  return std::visit(
      [&file](const auto& state) {
        const Moduli m = elastic_moduli(state.packing, ModuliOptions{});
        return StateModuli{file, m.B, m.B_S, state.target_stress.mean(), solid_fraction(state.packing)};
      },
      any);
}

std::optional<StateModuli> moduli_of_row(const PathTable& path, int row) {
  if (!path.table.has("state") || path.name == "stdin") return std::nullopt;
  const auto file =
      std::filesystem::path(path.name).parent_path() / path.table.text(row, path.table.column("state"));
  return std::filesystem::is_regular_file(file) ? std::optional(moduli_of(file.string())) : std::nullopt;
}

}  // namespace floc
