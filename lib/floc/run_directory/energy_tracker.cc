#include "floc/run_directory/energy_tracker.h"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <utility>

#include "floc/base/error.h"
#include "floc/relaxation/dynamics.h"

namespace floc {
namespace {

constexpr const char* kEnergyHeader =
    "step,branch,P,time,phi,work,elastic,kinetic,viscous,sliding,scaling,removed,initial,error,"
    "liquid,law,hysteresis";
/// Number of columns of energy.csv before the terms of the energy balance: step, branch, P, time and phi.
constexpr int kLeading = 5;

/// Reads the terms of the energy balance from a row of energy.csv. The balance of a resumed run continues from these
/// terms.
EnergyTerms terms_of(const std::string& row) {
  std::istringstream fields(row);
  std::string field;
  for (int k = 0; k < kLeading; ++k) std::getline(fields, field, ',');
  EnergyTerms t;
  double error =
      0.0;  // EnergyTerms has no member for the error, because the error follows from the other terms
  for (double* term : {&t.work, &t.elastic, &t.kinetic, &t.viscous, &t.sliding, &t.scaling, &t.removed,
                       &t.initial, &error, &t.liquid, &t.law, &t.hysteresis}) {
    std::getline(fields, field, ',');
    *term = std::strtod(field.c_str(), nullptr);
  }
  return t;
}

}  // namespace

template <int Dim>
EnergyTracker<Dim>::EnergyTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start)
    : MotionTable<Dim>(file, kEnergyHeader, run.point()),
      account_(std::move(start)),
      time_(run.point().time + run.point().equilibration_time) {
  const std::string last = this->last_row();
  if (!last.empty()) account_.continue_from(terms_of(last));
}

template <int Dim>
void EnergyTracker<Dim>::add_row_of(const Run<Dim>& run, const Packing<Dim>& packing, double time) {
  const EnergyTerms& t = account_.terms();
  this->add_row(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", this->place_of(run), time,
                            solid_fraction(packing), t.work, t.elastic, t.kinetic, t.viscous, t.sliding,
                            t.scaling, t.removed, t.initial, t.error(), t.liquid, t.law, t.hysteresis));
}

template <int Dim>
void EnergyTracker<Dim>::record(const Run<Dim>& run, const Packing<Dim>& packing, double time) {
  const double time_step = time - std::exchange(time_, time);
  // No balance is recorded while grains aggregate: the free flight of the clusters between collisions is not divided
  // into time steps.
  if (run.point().aggregating) {
    account_ = EnergyAccount<Dim>(packing);
    return;
  }
  if (account_.law() != packing.law) account_.change_law(packing.law);
  account_.advance(packing, time_step);
  if (++n_steps_ % kStepsPerChunk == 0) add_row_of(run, packing, time);
}

template <int Dim>
void EnergyTracker<Dim>::finish_step(const Run<Dim>& run) {
  add_row_of(run, run.packing(), time_);
}

void require_energy_account(const RunOptions& options) {
  if (options.assembly.box)
    throw InputError(
        "--track-energy",
        "the scene has walls (table [box]), but the energy balance can be recorded only in periodic cells");
  if (options.law.is_rigid())
    throw InputError(
        "--track-energy",
        "the contacts of the scene are rigid and store no elastic energy, so the energy balance cannot be "
        "recorded; expected a scene with elastic contacts");
  if (options.grains.shape)
    throw InputError(
        "--track-energy",
        "the grains of the scene have shapes and move in implicit time steps, which dissipate energy, so "
        "the energy balance cannot be recorded; expected disks or spheres");
  if (options.relaxation.finish != Finish::dynamic)
    throw InputError("--track-energy",
                     "Newton steps may find the equilibria of this scene without any motion, so that there is "
                     "no energy balance to record; expected equilibrium.finish = \"dynamic\"");
  // The assembly and each stage of the load path may have their own softening, so every step of the plan is tested.
  for (const PlannedEquilibrium& step :
       plan_run(options.assembly, options.law, options.load, options.dimension))
    if (step.cell.applied_to(options.relaxation).softening > 1.0)
      throw InputError(
          "--track-energy",
          fmt::format(
              "in the stage \"{}\", the contacts temporarily have softer springs than those of the "
              "contact law, so the energy balance cannot be recorded; expected a scene without softening",
              step.branch));
  for (const LoadStage& stage : options.load)
    if (stage.shear != 0.0)
      throw InputError(
          "--track-energy",
          fmt::format("stage \"{}\" is a simple shear: the periodic cell is transformed between its steps, so "
                      "the energy balance cannot be recorded; expected a scene without simple shear",
                      stage.name));
  // A saved packing is vibrated when the run begins, before the balance starts. A packing made from a gas is vibrated
  // between two equilibria, while the balance is recorded.
  if (options.assembly.vibration && options.assembly.protocol != AssemblyOptions::Protocol::state)
    throw InputError("--track-energy",
                     "assembly.vibration displaces the grains as hard bodies, without forces, so the energy "
                     "balance cannot be recorded; expected a scene without assembly.vibration");
}

template <int Dim>
std::unique_ptr<EnergyTracker<Dim>> track_energy(Run<Dim>& run, const RunOptions& options,
                                                 const RunDirectory& directory) {
  require_energy_account(options);
  // The contact law, and with it the energy, may change at the beginning of a step. To include this change of energy,
  // the balance starts from the equilibrium saved before the step, which still has the old law.
  const RunPoint& point = run.point();
  const bool at_a_state = point.step > 0 && point.equilibration.empty();
  auto tracker = std::make_unique<EnergyTracker<Dim>>(
      directory.energy_table(), run, at_a_state ? directory.start_of<Dim>(point.step) : run.packing());
  constexpr double kEveryStep = 0.0;
  run.set_observer({kEveryStep, [&run, recorder = tracker.get()](const Packing<Dim>& packing, double time) {
                      recorder->record(run, packing, time);
                    }});
  return tracker;
}

#define FLOC_INSTANTIATE(Dim)        \
  template class EnergyTracker<Dim>; \
  template std::unique_ptr<EnergyTracker<Dim>> track_energy(Run<Dim>&, const RunOptions&, const RunDirectory&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
