#include "floc/campaign/campaign_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/loading/run_plan.h"
#include "floc/packing/equilibrium.h"
#include "floc/relaxation/useful_threads.h"
#include "floc/scene/cost_model.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_source.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Largest relative difference between a pressure in a campaign file and the pressure of the state that it selects.
/// Because this difference is not zero, pressures in the file may be rounded, such as 1.33 for 1.334.
constexpr double kSamePressure = 0.01;

std::vector<std::string> overrides_of(const CampaignCase& one) {
  std::vector<std::string> texts;
  for (const SceneChange& change : one.changes) texts.push_back(change.text());
  return texts;
}

/// Returns the place in the campaign file to which an error in the scene of a case is attributed. If the error message
/// `fault` names a key that the case changes, this is the place of the change, otherwise the place of the case.
std::string blamed_place(const CampaignCase& one, const std::string& fault) {
  for (const SceneChange& change : one.changes)
    if (fault.find("--set " + change.text()) != std::string::npos) return change.place;
  return one.place;
}

/// Returns the reduced pressure P* of an equilibrium that a run will compute. P* follows from the imposed pressure, the
/// contact law and the largest diameter in the scene.
template <int Dim>
double planned_pressure(const Scene& scene, const PlannedEquilibrium& equilibrium, double pressure) {
  Packing<Dim> largest;
  largest.law = equilibrium.law;
  largest.grains = Grains<Dim>::with_size(1);
  largest.grains.radius[0] = 0.5 * scene.grains.largest();
  return reduced_pressure(largest, pressure);
}

/// Returns the stress that is imposed in an equilibrium on the driven axis, or on all axes if the load is isotropic.
/// Returns std::nullopt if this stress is not known before the run, for example because a strain is imposed on the
/// driven axis.
/// @param from  stress on each axis at the start of the stage, as far as it is known
std::optional<double> planned_driven_stress(const KnownStress& from, const PlannedEquilibrium& e) {
  if (e.is_isotropic()) return e.pressure;
  const auto axis = static_cast<std::size_t>(e.axis);
  if (e.axes[axis].load.kind == AxisLoad::strain || !from[axis]) return std::nullopt;
  StageReference start{e.control, e.axis, std::vector<double>(from.size(), 1.0), {}};
  for (const std::optional<double>& stress : from) start.stress.push_back(stress.value_or(0.0));
  return from.size() == 2 ? load_target<2>(e.axes, start).stress[e.axis]
                          : load_target<3>(e.axes, start).stress[e.axis];
}

std::vector<PlannedState> states_of(const Scene& scene) {
  std::vector<PlannedState> states;
  KnownStress from = first_stress(scene.assembly, scene.dimension);
  int stage = -1;
  for (const PlannedEquilibrium& e : plan_run(scene.assembly, scene.law, scene.load, scene.dimension)) {
    // `from` is updated at the first equilibrium of each stage. Every stage has at least one step, so no stage
    // is skipped.
    if (e.stage > stage && stage >= 0) from = after_stage(from, scene.load[static_cast<std::size_t>(stage)]);
    stage = e.stage;
    const auto reduced = [&](double pressure) {
      return scene.dimension == 2 ? planned_pressure<2>(scene, e, pressure)
                                  : planned_pressure<3>(scene, e, pressure);
    };
    PlannedState& state = states.emplace_back(PlannedState{e.branch, {}});
    if (e.is_isotropic()) state.P_star = reduced(e.pressure);
    if (const auto driven = planned_driven_stress(from, e)) state.P_driven_star = reduced(*driven);
  }
  return states;
}

bool same_value(const std::string& a, const std::string& b) {
  const auto x = parse_number<double>(a), y = parse_number<double>(b);
  return x && y ? *x == *y : a == b;
}

/// Returns the number of the state whose reduced pressure is nearest to P_star, among the states of a case. The
/// relative difference between the two pressures must be at most kSamePressure. `choice` determines which pressure is
/// compared: the pressure on all axes or the pressure on the driven axis.
/// @throws InputError listing the pressures of the states, if there is no such state
int state_at(double P_star, const StateChoice& choice, const CampaignCase& one, const CasePlan& plan) {
  int best = -1;
  double smallest = kSamePressure;
  std::vector<std::string> there;
  for (int k = 0; k < static_cast<int>(plan.states.size()); ++k) {
    const PlannedState& state = plan.states[static_cast<std::size_t>(k)];
    const std::optional<double>& reached = choice.is_driven ? state.P_driven_star : state.P_star;
    if (!reached || (!choice.branch.empty() && state.branch != choice.branch)) continue;
    there.push_back(fmt::format("{:.4g}", *reached));
    // Equal pressures are compared first: for two pressures of 0, the relative difference would be 0/0.
    const double off = *reached == P_star ? 0.0 : std::abs(*reached / P_star - 1.0);
    // A load path may reach a pressure several times, for example again during unloading. The first of these states is
    // chosen; the user can select a later one by its branch.
    if (off > smallest || (best >= 0 && off == smallest)) continue;
    best = k;
    smallest = off;
  }
  if (best >= 0) return best;
  const std::string where = choice.branch.empty() ? "" : fmt::format(" on branch {}", choice.branch);
  const char* name = choice.is_driven ? "P_driven_star" : "P_star";
  if (!there.empty())
    throw InputError(choice.place,
                     fmt::format("{} = {:g}: expected one of the pressures that case {} reaches{}: {}", name,
                                 P_star, one.label, where, fmt::join(there, ", ")));
  const std::string key =
      choice.branch.empty() ? fmt::format("{} = {:g}", name, P_star) : "branch = " + choice.branch;
  throw InputError(
      choice.place,
      choice.is_driven
          ? fmt::format("{}: case {} has no state{} whose stress on the driven axis is known before "
                        "the run: P_driven_star can select only such states; select other states by step",
                        key, one.label, where)
          : fmt::format("{}: case {} has no state{} with equal pressures on all axes: P_star "
                        "can select only such states; P_driven_star selects by the stress on the driven axis",
                        key, one.label, where));
}

}  // namespace

Scene scene_of(const Campaign& campaign, const CampaignCase& one) {
  try {
    return parse_scene(campaign.scene, campaign.scene_file,
                       fs::path(campaign.scene_file).parent_path().string(), overrides_of(one));
  } catch (const InputError& error) {
    throw InputError(blamed_place(one, error.what()), fmt::format("case {}: {}", one.label, error.what()));
  }
}

std::vector<int> chosen_states(const StateChoice& choice, const CampaignCase& one, const CasePlan& plan) {
  const int n = static_cast<int>(plan.states.size());
  std::set<int> chosen;
  switch (choice.kind) {
    case StateChoice::all:
      for (int k = 0; k < n; ++k) chosen.insert(k);
      break;
    case StateChoice::last:
      chosen.insert(n - 1);
      break;
    case StateChoice::steps:
      for (const int step : choice.numbers) {
        if (step >= n)
          throw InputError(
              choice.place,
              fmt::format("step = {}: the states of case {} have the numbers 0 to {}", step, one.label, n - 1));
        chosen.insert(step);
      }
      break;
    case StateChoice::pressures:
      for (const double P_star : choice.P_star) chosen.insert(state_at(P_star, choice, one, plan));
      break;
  }
  return {chosen.begin(), chosen.end()};
}

bool is_meant(const Reference& reference, const CampaignCase& one) {
  return std::all_of(reference.when.begin(), reference.when.end(),
                     [&](const SceneChange& key) { return same_value(value_of(one, key.key), key.value); });
}

std::vector<CasePlan> plan_cases(const Campaign& campaign) {
  std::vector<CasePlan> plans;
  for (const CampaignCase& one : campaign.cases) {
    const Scene scene = scene_of(campaign, one);
    if (!scene.is_random() && campaign.seeds.size() > 1)
      throw InputError(
          one.place,
          fmt::format("case {}: all seeds would give the same sample, because the scene starts from a state at "
                      "rest: expected the key assembly.agitation in the scene, or a single seed",
                      one.label));
    CasePlan& plan = plans.emplace_back();
    plan.states = states_of(scene);
    plan.threads = useful_threads(scene.grains.count, scene.dimension, scene.relaxation.threads);
    const RunCost cost = cost_of_run(scene);
    plan.cost = cost.core_seconds;
    plan.is_priced = cost.is_priced();
    // The states are chosen here only to report a missing state before any run begins.
    for (const Collection& c : campaign.collections) {
      (void)chosen_states(c.states, one, plan);
      if (c.table == "compare" && chosen_states(c.before, one, plan).size() != 1)
        throw InputError(
            c.before.place,
            "before: several states are selected: expected the one state with which the others are compared");
    }
  }
  for (const Reference& r : campaign.references) {
    bool meant = false;
    for (std::size_t k = 0; k < plans.size(); ++k) {
      if (!is_meant(r, campaign.cases[k])) continue;
      meant = true;
      if (r.fit.empty() && chosen_states(r.state, campaign.cases[k], plans[k]).size() != 1)
        throw InputError(r.state.place,
                         "state: several states are selected: expected the one state whose value is compared");
    }
    // A reference that applies to no case is an error: no result would be compared with it.
    if (!meant)
      throw InputError(r.place,
                       "when: no case of this campaign has these values of its keys: expected the values of at "
                       "least one case");
  }
  return plans;
}

std::vector<CampaignRun> runs_of(const Campaign& campaign) {
  std::vector<CampaignRun> runs;
  for (std::size_t k = 0; k < campaign.cases.size(); ++k)
    for (const std::uint64_t seed : campaign.seeds)
      runs.push_back(
          {static_cast<int>(k), seed, fmt::format("runs/{}/seed-{}", campaign.cases[k].label, seed)});
  return runs;
}

std::string portable_scene(const Campaign& campaign) {
  const fs::path directory = fs::path(campaign.scene_file).parent_path();
  const Scene scene = parse_scene(campaign.scene, campaign.scene_file, directory.string());
  if (!scene.starts_from_state()) return scene.text;
  const SceneSource source(campaign.scene, campaign.scene_file, {});
  const auto state = source.root()["assembly"]["state"].value<std::string>();
  const std::string absolute = fs::absolute(directory / state.value_or("")).lexically_normal().string();
  return parse_scene(campaign.scene, campaign.scene_file, directory.string(),
                     {fmt::format("assembly.state=\"{}\"", absolute)})
      .text;
}

}  // namespace floc
