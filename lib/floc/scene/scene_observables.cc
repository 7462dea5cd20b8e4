#include "floc/scene/scene_observables.h"

#include <algorithm>
#include <initializer_list>
#include <map>

#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

bool is_elastic(const Scene& scene) {
  return !scene.law.is_rigid();
}

bool is_rigid(const Scene& scene) {
  return scene.law.is_rigid();
}

bool has_walls(const Scene& scene) {
  return scene.assembly.box.has_value();
}

bool has_liquid(const Scene& scene) {
  return scene.law.parameters().adhesion.holds<CapillaryAdhesion>();
}

bool is_cohesive(const Scene& scene) {
  return scene.law.has_adhesion();
}

bool has_friction(const Scene& scene) {
  return scene.law.has_friction();
}

bool has_control(const Scene& scene, std::initializer_list<const char*> controls) {
  return std::ranges::any_of(scene.load, [&](const LoadStage& stage) {
    return std::ranges::find(controls, stage.control) != controls.end();
  });
}

bool is_oedometer(const Scene& scene) {
  return has_control(scene, {"oedometric"});
}

bool is_sheared(const Scene& scene) {
  return has_control(scene, {"triaxial", "constant_volume", "simple_shear"});
}

bool is_drained_test(const Scene& scene) {
  return has_control(scene, {"triaxial"});
}

bool has_lateral_axes(const Scene& scene) {
  return has_control(scene, {"oedometric", "triaxial", "constant_volume", "axes"});
}

bool raises_pressure(const Scene& scene) {
  if (scene.load.empty()) return false;
  const LoadStage& first = scene.load.front();
  return first.is_isotropic() ? first.to > scene.assembly.pressure : first.control == "oedometric";
}

}  // namespace

bool has_observable(const Scene& scene, const std::string& name) {
  static const std::map<std::string, bool (*)(const Scene&)> kConditions = {{"B", is_elastic},
                                                                            {"G", is_elastic},
                                                                            {"B_reuss", is_elastic},
                                                                            {"tail_minus", is_cohesive},
                                                                            {"lambda", raises_pressure},
                                                                            {"alpha", raises_pressure},
                                                                            {"Phi_max", raises_pressure},
                                                                            {"mobilised", has_friction},
                                                                            {"n_wall_contacts", has_walls},
                                                                            {"lateral_ratio", has_lateral_axes},
                                                                            {"stress_ratio", is_sheared},
                                                                            {"bridges", has_liquid},
                                                                            {"bridge_volume", has_liquid},
                                                                            {"z_pairs", is_rigid},
                                                                            {"indeterminacy", is_rigid},
                                                                            {"force_freedom", is_rigid},
                                                                            {"K0", is_oedometer},
                                                                            {"M_oedometer", is_oedometer},
                                                                            {"peak_ratio", is_sheared},
                                                                            {"critical_ratio", is_sheared},
                                                                            {"dilatancy", is_drained_test}};
  const auto condition = kConditions.find(name);
  return condition == kConditions.end() || condition->second(scene);
}

}  // namespace floc
