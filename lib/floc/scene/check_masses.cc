#include "floc/scene/check_masses.h"

#include <fmt/format.h>

namespace floc {

std::string equal_masses_fault(const RunOptions& run) {
  if (run.has_contact_dynamics())
    return "contact dynamics moves these grains, whose time step does not depend on the masses";
  if (run.assembly.box && !run.assembly.box->gravity.isZero(0.0))
    return "the weights of the grains follow from their own masses, and the scene has gravity";
  return "";
}

void check_masses(TableReader& root, const Scene& scene) {
  if (!scene.relaxation.equal_masses) return;
  const std::string fault = equal_masses_fault(scene);
  if (fault.empty()) return;
  TableReader equilibrium = root.table("equilibrium", "", TableReader::Need::optional);
  equilibrium.fault("masses", fmt::format("{} = \"equal\" is not allowed here: {}; expected \"own\" or no key",
                                          equilibrium.path_of("masses"), fault));
}

}  // namespace floc
