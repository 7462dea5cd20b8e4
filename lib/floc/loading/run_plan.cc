#include "floc/loading/run_plan.h"

#include <fmt/format.h>

#include "floc/base/error.h"
#include "floc/contact/law_description.h"

namespace floc {

double* law_number(LawParameters& law, const std::string& key) {
  for (const LawNumber& n : numbers_of(law))
    if (n.key == key) return n.value;
  return nullptr;
}

void change_law(LawParameters& law, const std::string& key, double value) {
  double* const target = law_number(law, key);
  if (target == nullptr)
    throw InputError("load.set",
                     fmt::format("{} = {}: the scene's contact law has no such parameter", key, value));
  *target = value;
  const std::vector<std::string> faults = law.validate();
  if (!faults.empty()) throw InputError("load.set", faults.front());
}

std::vector<PlannedEquilibrium> plan_run(const AssemblyOptions& assembly, const LawParameters& law,
                                         const std::vector<LoadStage>& load) {
  std::vector<PlannedEquilibrium> plan;
  LawParameters assembling = law;
  if (assembly.friction) change_law(assembling, "friction.coefficient", *assembly.friction);
  if (assembly.protocol == AssemblyOptions::Protocol::aggregation)
    plan.push_back({"assembly", 0.0, assembling, assembly.cell, {}});
  if (plan.empty() || assembly.pressure > 0.0)
    plan.push_back({"assembly", assembly.pressure, assembling, assembly.cell, {}});
  if (assembly.vibration) {
    if (assembly.protocol != AssemblyOptions::Protocol::state)
      plan.push_back({"assembly", assembly.pressure, law, assembly.cell, {}});
    plan.back().vibration = assembly.vibration;
  }
  LawParameters present = law;
  for (const LoadStage& stage : load) {
    for (const auto& [key, value] : stage.set) change_law(present, key, value);
    for (const double pressure : stage_pressures(plan.back().pressure, stage))
      plan.push_back({stage.name, pressure, present, stage.cell, {}});
  }
  for (const PlannedEquilibrium& equilibrium : plan)
    if (equilibrium.pressure == 0.0 && equilibrium.law.pull_off_force() == 0.0)
      throw InputError(
          "load", fmt::format("branch \"{}\" asks for equilibrium at zero pressure without adhesion: nothing "
                              "holds the grains together, expected a pressure > 0",
                              equilibrium.branch));
  return plan;
}

}  // namespace floc
