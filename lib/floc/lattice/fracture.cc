#include "floc/lattice/fracture.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace floc {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Element that breaks first when the load increases, and the ratio of the load at which it breaks to the present load.
struct Weakest {
  int element = -1;
  double factor = kNever;
};

template <int Dim>
Weakest weakest_of(const LatticeNetwork<Dim>& network, const LatticeSolution<Dim>& solution,
                   const ElementStrength& strength, const std::vector<bool>& gone) {
  // Tensions that may be rounding errors of the forces do not break an element.
  double largest = 0.0;
  for (const double f : solution.normal_force) largest = std::max(largest, std::abs(f));
  const double least = 1e-9 * largest;
  Weakest out;
  for (int e = 0; e < static_cast<int>(network.elements.size()); ++e) {
    const double tension = -solution.normal_force[e];
    if (gone[e] || tension <= least) continue;
    const double factor = strength.tension[static_cast<std::size_t>(network.elements[e].kind)] / tension;
    if (factor < out.factor) out = {e, factor};
  }
  return out;
}

}  // namespace

std::vector<std::string> ElementStrength::validate() const {
  std::vector<std::string> faults;
  for (int k = 0; k < kElementKinds; ++k)
    if (!(tension[k] > 0.0))
      faults.push_back(fmt::format("strength of elements of kind {} = {}: must be > 0",
                                   name_of(static_cast<ElementKind>(k)), tension[k]));
  return faults;
}

template <int Dim>
FracturePath fracture(const LatticeNetwork<Dim>& network, LatticeSolver<Dim>& solver,
                      const LatticeLoad<Dim>& load, int axis, const FractureOptions& options) {
  refuse_faults(options.strength.validate());
  require_in_range("end_at", options.end_at, FractureOptions::kShare);
  const int measured = measured_component(load, axis);
  FracturePath path;
  std::vector<bool> gone(network.elements.size(), false);
  while (true) {
    if (static_cast<int>(path.broken.size()) >= options.most_broken) {
      path.end =
          fmt::format("{} elements have broken, which is the largest allowed number", path.broken.size());
      break;
    }
    const LatticeSolution<Dim> solution = solver.solve(load);
    // Without a solution in equilibrium, the tensions are meaningless, so no element may be chosen from them.
    if (!solution.report.holds || !solution.report.converged) {
      path.end = solution.report.holds ? "the solution has not converged"
                                       : "the remaining elements do not resist the load";
      break;
    }
    const Weakest weakest = weakest_of(network, solution, options.strength, gone);
    if (weakest.factor == kNever) {
      path.end = path.broken.empty() ? "no element that could break is in tension"
                                     : "none of the remaining elements can break";
      break;
    }
    // The response is proportional to the load: a load of another magnitude opens or closes no one-sided element,
    // because these elements have no gap at zero load. Therefore the state at the breakage is the solution times the
    // factor.
    const Breakage next{weakest.element, weakest.factor * solution.strain[measured],
                        weakest.factor * solution.stress[measured]};
    path.broken.push_back(next);
    if (std::abs(next.stress) > path.strength) {
      path.strength = std::abs(next.stress);
      path.strain_at_strength = next.strain;
    }
    if (options.observe && !options.observe(next, static_cast<int>(path.broken.size()))) {
      path.end = "the calculation was stopped";
      break;
    }
    // If the stress were compared with the last value instead of the largest value so far, a decrease in many small
    // steps would never end the simulation.
    if (std::abs(next.stress) < options.end_at * path.strength) {
      path.end = fmt::format("the stress has fallen below {:.2g} of its largest value", options.end_at);
      break;
    }
    gone[weakest.element] = true;
    solver.remove(weakest.element);
  }
  return path;
}

template FracturePath fracture(const LatticeNetwork<2>&, LatticeSolver<2>&, const LatticeLoad<2>&, int,
                               const FractureOptions&);
template FracturePath fracture(const LatticeNetwork<3>&, LatticeSolver<3>&, const LatticeLoad<3>&, int,
                               const FractureOptions&);

}  // namespace floc
