#include "floc/loading/run_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "floc/base/error.h"
#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

/// Adds to the plan the steps of a stage whose axes have different loads or different initial stresses.
/// @param from  stress on each axis before the stage; no value for an axis whose stress is unknown before the run
/// @param step  equilibrium whose values apply to all steps of the stage
void plan_axes(const KnownStress& from, const LoadStage& stage, PlannedEquilibrium step,
               std::vector<PlannedEquilibrium>& plan) {
  step.control = stage.is_isotropic() ? "isotropic" : stage.control;
  step.axis = stage.is_isotropic() ? static_cast<int>(from.size()) - 1 : stage.axis;
  const int n = number_of_steps(from, stage);
  for (int k = 1; k <= n; ++k) {
    step.axes.clear();
    for (std::size_t a = 0; a < from.size(); ++a) {
      const AxisLoad load = stage.is_isotropic() ? AxisLoad{AxisLoad::stress, stage.to} : stage.axes[a];
      step.axes.push_back({load, k == n ? 1.0 : static_cast<double>(k) / n});
    }
    step.shear = stage.shear * k / n;
    step.shear_step = stage.shear / n;
    plan.push_back(step);
  }
}

/// Checks that a stage has one load for each axis of the scene, and that the driven axis exists. Later code uses axis
/// numbers as indices without checking them.
void check_axes(const LoadStage& stage, int dimension) {
  if (stage.is_isotropic()) return;
  if (std::ssize(stage.axes) != dimension)
    throw InputError(
        "load",
        fmt::format("the stage \"{}\" has loads for {} axes: expected {}, one for each axis of the scene",
                    stage.name, stage.axes.size(), dimension));
  if (stage.axis < 0 || stage.axis >= dimension)
    throw InputError("load", fmt::format("the stage \"{}\" drives axis {}: expected an axis from 1 to {}",
                                         stage.name, stage.axis + 1, dimension));
}

/// Whether a planned equilibrium cannot exist, because the load on an axis is zero and the grains do not adhere.
bool has_nothing_to_hold_it(const PlannedEquilibrium& e) {
  if (e.law.adheres()) return false;
  if (e.is_isotropic()) return e.pressure == 0.0;
  return std::any_of(e.axes.begin(), e.axes.end(), [](const AxisStep& s) {
    return s.load.kind == AxisLoad::stress && s.load.end == 0.0 && s.share == 1.0;
  });
}

/// Returns the planned equilibrium of a saved packing that keeps its saved stresses.
PlannedEquilibrium kept_equilibrium(const AssemblyOptions& assembly, const Law& law) {
  PlannedEquilibrium kept{"assembly", assembly.pressure, law, assembly.cell, {}};
  kept.control = "axes";
  kept.axis = assembly.saved.kept->axis;
  for (const double stress : assembly.saved.kept->stress)
    kept.axes.push_back({{AxisLoad::stress, stress}, 1.0});
  return kept;
}

}  // namespace

KnownStress first_stress(const AssemblyOptions& assembly, int dimension) {
  if (!assembly.saved.kept) return KnownStress(static_cast<std::size_t>(dimension), assembly.pressure);
  return {assembly.saved.kept->stress.begin(), assembly.saved.kept->stress.end()};
}

double* law_number(LawParameters& law, const std::string& key) {
  for (const LawNumber& n : numbers_of(law))
    if (n.key == key) return n.value;
  return nullptr;
}

void change_law(Law& law, const std::string& key, double value) {
  LawParameters parameters = law;
  double* const target = law_number(parameters, key);
  if (target == nullptr)
    throw InputError("load.set",
                     fmt::format("{} = {}: the contact law of the scene has no such parameter", key, value));
  *target = value;
  const std::vector<std::string> faults = parameters.validate();
  if (!faults.empty()) throw InputError("load.set", faults.front());
  law = parameters;
}

std::vector<PlannedEquilibrium> plan_run(const AssemblyOptions& assembly, const Law& law,
                                         const std::vector<LoadStage>& load, int dimension) {
  std::vector<PlannedEquilibrium> plan;
  Law assembling = law;
  if (assembly.friction) change_law(assembling, "friction.coefficient", *assembly.friction);
  if (assembly.protocol == AssemblyOptions::Protocol::aggregation)
    plan.push_back({"assembly", 0.0, assembling, assembly.cell, {}});
  if (assembly.saved.kept)
    plan.push_back(kept_equilibrium(assembly, assembling));
  else if (plan.empty() || assembly.pressure > 0.0)
    plan.push_back({"assembly", assembly.pressure, assembling, assembly.cell, {}});
  if (assembly.vibration) {
    if (assembly.protocol != AssemblyOptions::Protocol::state)
      plan.push_back({"assembly", assembly.pressure, law, assembly.cell, {}});
    plan.back().vibration = assembly.vibration;
  }
  Law present = law;
  KnownStress stress = assembly.saved.kept
                           ? first_stress(assembly, dimension)
                           : KnownStress(static_cast<std::size_t>(dimension), plan.back().pressure);
  for (int s = 0; s < static_cast<int>(load.size()); ++s) {
    const LoadStage& stage = load[static_cast<std::size_t>(s)];
    check_axes(stage, dimension);
    for (const auto& [key, value] : stage.set) change_law(present, key, value);
    PlannedEquilibrium step{stage.name, stage.to, present, stage.cell, {}, s};
    if (stage.is_isotropic() && is_isotropic(stress)) {
      for (const double pressure : stage_pressures(*stress.front(), stage)) {
        step.pressure = pressure;
        plan.push_back(step);
      }
    } else {
      plan_axes(stress, stage, step, plan);
    }
    stress = after_stage(stress, stage);
  }
  for (const PlannedEquilibrium& equilibrium : plan)
    if (has_nothing_to_hold_it(equilibrium))
      throw InputError("load",
                       fmt::format("the stage \"{}\" requires an equilibrium at zero pressure, but without "
                                   "adhesion nothing holds the grains together; expected a positive pressure",
                                   equilibrium.branch));
  return plan;
}

}  // namespace floc
