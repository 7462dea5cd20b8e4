#include "floc/structure/pressure_phases.h"

#include <algorithm>
#include <cassert>

#include "floc/network/components.h"

namespace floc {
namespace {

template <int Dim>
PressurePhase phase_of(const ContactNetwork<Dim>& network, const Adjacency& of,
                       const std::vector<double>& pressure, double sign) {
  PressurePhase phase;
  for (const double p : pressure)
    if (sign * p > 0.0) ++phase.n_grains, phase.mean += p;
  if (phase.n_grains == 0) return phase;
  phase.mean /= phase.n_grains;
  phase.share = static_cast<double>(phase.n_grains) / network.n_grains;
  std::vector<bool> active;
  for (const NetworkContact<Dim>& c : network.contacts)
    active.push_back(sign * pressure[c.i] > 0.0 && sign * pressure[c.j] > 0.0);
  int n_joined = 0;
  phase.largest_cluster = 1;
  for (const Component<Dim>& part : find_components(network, of, active)) {
    const auto size = static_cast<int>(part.grains.size());
    ++phase.n_clusters;
    n_joined += size;
    phase.largest_cluster = std::max(phase.largest_cluster, size);
    phase.n_directions = std::max(phase.n_directions, static_cast<int>(part.winding.size()));
  }
  phase.n_clusters += phase.n_grains - n_joined;
  return phase;
}

}  // namespace

template <int Dim>
PressurePhases pressure_phases(const ContactNetwork<Dim>& network, const std::vector<double>& pressure) {
  assert(static_cast<int>(pressure.size()) == network.n_grains);
  const Adjacency of = contacts_of_grains(network);
  return {phase_of(network, of, pressure, 1.0), phase_of(network, of, pressure, -1.0)};
}

template PressurePhases pressure_phases(const ContactNetwork<2>&, const std::vector<double>&);
template PressurePhases pressure_phases(const ContactNetwork<3>&, const std::vector<double>&);

}  // namespace floc
