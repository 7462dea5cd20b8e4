#include <floc/floc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

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

/// Runs the tiny scene up to the given step. If the directory already contains the run, resumes it.
bool run_until(const std::string& scene, const std::string& directory, int step) {
  floc::SceneRunOptions options;
  options.directory = directory;
  options.until = step;
  options.resume = true;
  return floc::run_scene(scene, options).outcome == floc::DriveReport::done;
}

bool is_equilibrium(const std::string& file) {
  bool holds = true;
  for (const floc::Criterion& c : floc::verify_state(floc::read_state(file), file)) {
    if (!c.holds) std::printf("%s: %s does not hold: %s\n", file.c_str(), c.name, c.where.c_str());
    holds = holds && c.holds;
  }
  return holds;
}

bool has(const floc::Table& table, const std::string& column) {
  for (const std::string& name : table.columns)
    if (name == column) return table.rows.size() == 1;
  std::printf("no column %s\n", column.c_str());
  return false;
}

/// Computes every table with one call. Writes a copy of the state and reads it back.
bool computes(const std::string& file) {
  const floc::AnyState state = floc::read_state(file);
  std::visit([&](const auto& s) { floc::write_state(file + ".copy", s); }, state);
  std::ifstream a(file, std::ios::binary), b(file + ".copy", std::ios::binary);
  std::stringstream first, second;
  first << a.rdbuf();
  second << b.rdbuf();
  return first.str() == second.str() && has(floc::moduli_table(state), "B") &&
         has(floc::network_table(state), "z_star") && has(floc::structure_table(state), "xi");
}

/// Fits a curve that has a plateau followed by a line in ln P.
bool fits() {
  floc::ConsolidationCurve curve;
  for (int k = 0; k < 30; ++k) {
    const double P = std::pow(10.0, -2.0 + 0.1 * k);
    curve.P_star.push_back(P);
    curve.phi.push_back(1.0 / (2.5 - 0.2 * std::max(0.0, std::log(P / 0.05))));
  }
  floc::ConsolidationOptions options;
  options.law = floc::ConsolidationLaw::log;
  const floc::ConsolidationFit fit = floc::fit_consolidation(curve, options);
  const floc::FittedParameter* lambda = fit.found() ? fit.find("lambda") : nullptr;
  return lambda != nullptr && lambda->value && std::abs(*lambda->value - 0.2) < 0.01;
}

}  // namespace

/// Runs a tiny scene in the directory that the argument names, resumes the run, and verifies and analyses its states.
int main(int, char** argv) {
  const std::string directory = argv[1], scene = directory + ".toml";
  std::ofstream(scene) << kScene;
  bool right = run_until(scene, directory, 0) && run_until(scene, directory, 2);
  for (int step = 0; step < 3; ++step) right = right && is_equilibrium(floc::state_file(directory, step));
  right = right && computes(floc::state_file(directory, 2)) && fits();
  std::printf("floc %s: %s\n", floc::version().c_str(), right ? "right" : "wrong");
  return right ? 0 : 1;
}
