#include <cstdio>
#include <variant>

#include "floc/base/version.h"
#include "floc/contact/law_table.h"
#include "floc/run/drive.h"
#include "floc/run/verification.h"
#include "floc/scene/read_scene.h"

namespace {

constexpr const char* kScene = R"([scene]
name = "tiny"
dimension = 2
units = "reduced"
[grains]
count = 20
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e4}
adhesion = {law = "tail", force = 1.0, range = 1e-2}
damping = {restitution = 0.015}
friction = {coefficient = 0.5, stiffness = 1e4}
[cell]
solid_fraction = 0.5
mass = 1.0
strain_rate_cap = 0.05
[assembly]
protocol = "direct"
pressure = 0.01
[[load]]
name = "load"
to = 0.1
steps = 2
[run]
seed = 3
)";

bool law_is_right() {
  floc::LawParameters parameters;
  parameters.normal = floc::LinearRepulsion{100.0};
  parameters.adhesion = floc::ConstantAdhesion{2.0};
  const auto force = [](const auto& law) { return law.normal(floc::PairGeometry<>(-0.25)).force(); };
  return std::visit(force, floc::compose_law(parameters)) == 23.0;
}

/// Drives the tiny run of a directory up to a step, going on from where it is.
bool drive_until(const char* path, int step) {
  const floc::Scene scene = floc::parse_scene(kScene, "tiny.toml", ".");
  floc::RunDirectory directory(path, floc::Existing::resume, scene);
  floc::Run<2> run = floc::start_or_resume<2>(directory, scene);
  floc::DriveOptions<2> driving;
  driving.until = step;
  const bool done = floc::drive(run, directory, driving).outcome == floc::DriveReport::done;
  return done && run.point().step == step + 1;
}

bool is_equilibrium(const std::string& file) {
  bool holds = true;
  const auto verify = [](const auto& state) { return floc::verify_equilibrium(state); };
  for (const floc::Criterion& c : std::visit(verify, floc::read_state(file))) {
    if (!c.holds) std::printf("%s: %s does not hold: %s\n", file.c_str(), c.name, c.where.c_str());
    holds = holds && c.holds;
  }
  return holds;
}

}  // namespace

/// Runs a tiny scene in the directory named, resumes it and verifies its states.
int main(int, char** argv) {
  bool right = law_is_right() && drive_until(argv[1], 0) && drive_until(argv[1], 2);
  for (int step = 0; step < 3; ++step) right = right && is_equilibrium(floc::state_file(argv[1], step));
  std::printf("floc %s: %s\n", floc::version().c_str(), right ? "right" : "wrong");
  return right ? 0 : 1;
}
