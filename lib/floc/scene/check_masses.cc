#include "floc/scene/check_masses.h"

#include <fmt/format.h>

namespace floc {

bool allows_equal_masses(const RunOptions& run) {
  const bool has_gravity = run.assembly.box && !run.assembly.box->gravity.isZero(0.0);
  return !has_gravity && !run.has_contact_dynamics();
}

void check_masses(TableReader& root, const Scene& scene) {
  if (!scene.relaxation.equal_masses || scene.has_contact_dynamics() || allows_equal_masses(scene)) return;
  TableReader equilibrium = root.table("equilibrium", "", TableReader::Need::optional);
  equilibrium.fault(
      "masses",
      fmt::format("{} = \"equal\" is not allowed here: the weights of the grains follow from their own "
                  "masses, and the scene has gravity; expected \"own\" or no key",
                  equilibrium.path_of("masses")));
}

}  // namespace floc
