#include "floc/scene/scene_kind.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "floc/contact/law_parameters.h"
#include "floc/loading/run_plan.h"

namespace floc {
namespace {

std::string grains_word(const Scene& scene) {
  const bool flat = scene.dimension == 2;
  const std::string law = scene.law.normal_keyword();
  if (scene.law.is_rigid()) {
    if (scene.grains.shape) return flat ? "rigid-polygons" : "rigid-polyhedra";
    return flat ? "rigid-disks" : "rigid-spheres";
  }
  if (scene.grains.shape) return flat ? "polygons" : "polyhedra";
  if (law == LinearRepulsion::kKeyword) return flat ? "disks" : "spheres";
  return (flat ? "disks-" : "beads-") + law;
}

/// Returns the word that describes the cohesion of the grains in the name of the kind; empty if the name contains no
/// such word.
std::string cohesion_word(const Scene& scene) {
  const auto plan = plan_run(scene.assembly, scene.law, scene.load, scene.dimension);
  const auto on_path = [&](auto&& has) {
    return std::any_of(plan.begin(), plan.end(), [&](const PlannedEquilibrium& e) { return has(e.law); });
  };
  if (on_path([](const Law& law) { return law.parameters().adhesion.holds<CapillaryAdhesion>(); }))
    return "wet";
  if (on_path([](const Law& law) { return law.adheres(); })) return "cohesive";
  return scene.law.normal_keyword() == std::string(LinearRepulsion::kKeyword) ? "cohesionless" : "";
}

std::string load_word(const std::string& control, int dimension) {
  if (control == "oedometric") return "oedometer";
  if (control == "triaxial") return dimension == 2 ? "biaxial" : "triaxial";
  std::string word = control;
  std::replace(word.begin(), word.end(), '_', '-');
  return word;
}

}  // namespace

std::string scene_kind(const Scene& scene) {
  std::vector<std::string> words = {grains_word(scene)};
  if (const std::string word = cohesion_word(scene); !word.empty()) words.push_back(word);
  if (scene.assembly.box) words.emplace_back("walls");
  if (scene.assembly.box && !scene.assembly.box->gravity.isZero(0.0)) words.emplace_back("gravity");
  for (const LoadStage& stage : scene.load) {
    if (stage.is_isotropic() && stage.shear == 0.0) continue;
    const std::string word = load_word(stage.control, scene.dimension);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  return fmt::format("{}", fmt::join(words, "-"));
}

}  // namespace floc
