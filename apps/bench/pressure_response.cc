// Compares, for packings of spheres, the response to a change of pressure with the elastic moduli.
//
// The moduli are those of a network in which every contact consists of two springs, with the present normal and
// tangential stiffness of the contact. The contact law differs from this network: if the normal force decreases, the
// tangential force of Mindlin's law is reduced with the stiffness, and contacts with fully mobilised friction slide.
// The response therefore depends on the sign of the change (docs/physics.md, "Moduli and the response"). Each state is
// first brought to equilibrium up to rounding errors. Its pressure is then raised or lowered by the fraction SHARE, and
// Newton steps with the contact law find the new equilibrium.
//
//   floc_pressure_response [--step SHARE] STATE...
//
// Prints one row for each state and each sign of the change of the pressure P: the bulk modulus of the network with
// prestress; the bulk modulus -dP/d(ln V) from the change of the volume V; the number of contacts with fully mobilised
// friction before the change; and the number of contacts that open or close during the change.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/io/state_file.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/static_solver.h"

namespace floc {
namespace {

StaticSolution<3> balanced(const Packing<3>& from, double pressure) {
  StaticSolverOptions options;
  options.target = 1e-11;
  options.max_iterations = 60;
  options.largest_mobilised_share = 1.0;
  return solve_statics(from, Vec<3>(Vec<3>::Constant(pressure)), options);
}

int count_mobilised(const Packing<3>& packing) {
  int n = 0;
  for (const Contact<3>& c : packing.contacts) n += c.sliding;
  return n;
}

std::set<std::array<int, 5>> touching(const Packing<3>& packing) {
  std::set<std::array<int, 5>> pairs;
  for (const Contact<3>& c : packing.contacts) pairs.insert({c.i, c.j, c.image[0], c.image[1], c.image[2]});
  return pairs;
}

/// Counts the contacts that exist in only one of two packings.
std::size_t count_changed(const Packing<3>& from, const Packing<3>& to) {
  const auto before = touching(from), after = touching(to);
  std::vector<std::array<int, 5>> changed;
  std::set_symmetric_difference(before.begin(), before.end(), after.begin(), after.end(),
                                std::back_inserter(changed));
  return changed.size();
}

/// Returns the bulk modulus of the contact network, with prestress, for an isotropic increment of stress. The modulus
/// is the inverse of the sum of all compliances that relate normal strains to normal stresses.
double bulk_modulus(const Packing<3>& packing) {
  ModuliOptions options;
  options.prestress = true;
  return 1.0 / Mat<3>(elastic_moduli(packing, options).C).inverse().sum();
}

void print_response(const std::string& file, const State<3>& state, double step) {
  const double pressure = state.target_stress.mean();
  const StaticSolution<3> start = balanced(state.packing, pressure);
  if (!start.converged) {
    fmt::print("{:<32} {:>10.4g}  no equilibrium found: {}\n", file, pressure, start.reason);
    return;
  }
  const double expected = bulk_modulus(start.packing);
  for (const double sign : {1.0, -1.0}) {
    const StaticSolution<3> end = balanced(start.packing, pressure * (1.0 + sign * step));
    if (!end.converged) {
      fmt::print("{:<32} {:>10.4g} {:>3}  no equilibrium found: {}\n", file, pressure, sign > 0.0 ? "+" : "-",
                 end.reason);
      continue;
    }
    const double found =
        -sign * step * pressure / std::log(end.packing.cell.volume() / start.packing.cell.volume());
    fmt::print("{:<32} {:>10.4g} {:>3} {:>12.6g} {:>12.6g} {:>11.2e} {:>7} {:>7} {:>8}\n", file, pressure,
               sign > 0.0 ? "+" : "-", expected, found, found / expected - 1.0, start.packing.contacts.size(),
               count_mobilised(start.packing), count_changed(start.packing, end.packing));
  }
}

}  // namespace
}  // namespace floc

int main(int argc, char** argv) {
  double step = 1e-4;
  std::vector<std::string> files;
  for (int k = 1; k < argc; ++k) {
    if (std::string_view(argv[k]) == "--step" && k + 1 < argc)
      step = std::atof(argv[++k]);
    else
      files.emplace_back(argv[k]);
  }
  if (files.empty() || !(step > 0.0)) {
    fmt::print(stderr, "usage: floc_pressure_response [--step SHARE] STATE...\n");
    return 2;
  }
  fmt::print("{:<32} {:>10} {:>3} {:>12} {:>12} {:>11} {:>7} {:>7} {:>8}\n", "state", "P", "dP", "B",
             "-dP/dlnV", "difference", "contact", "at_cap", "changed");
  for (const std::string& file : files) {
    const floc::AnyState any = floc::read_state(file);
    if (const auto* state = std::get_if<floc::State<3>>(&any))
      floc::print_response(file, *state, step);
    else
      fmt::print("{:<32}  this file is not a state of spheres\n", file);
  }
  return 0;
}
