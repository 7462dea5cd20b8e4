#include "floc/elasticity/network_mechanics.h"

#include <algorithm>
#include <cmath>

#include "floc/elasticity/backbone.h"

namespace floc {
namespace {

double share(const std::vector<bool>& flags) {
  return static_cast<double>(std::count(flags.begin(), flags.end(), true)) / static_cast<double>(flags.size());
}

}  // namespace

template <int Dim>
ContactMechanics<Dim> contact_mechanics(const ContactNetwork<Dim>& network, const Moduli& moduli) {
  ContactMechanics<Dim> out;
  out.isotropic = step_response(network, moduli.response, StressStep::isotropic);
  out.deviatoric = step_response(network, moduli.response, StressStep::deviatoric);
  out.percolation = find_percolation(network);
  for (const auto* step : {&out.isotropic, &out.deviatoric}) {
    if (!*step) continue;
    const std::vector<bool> carries = mechanical_backbone(network, **step);
    if (out.backbone.empty()) out.backbone.resize(carries.size(), false);
    for (std::size_t c = 0; c < carries.size(); ++c) out.backbone[c] = out.backbone[c] || carries[c];
  }
  return out;
}

template <int Dim>
NetworkMechanics network_mechanics(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                   const Moduli& moduli, const ContactMechanics<Dim>& contacts) {
  NetworkMechanics out;
  const int n_held = network.n_grains - moduli.n_rattlers;
  int n_touching = 0, n_between_grains = 0;
  double kn = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts)
    if (!c.distant) ++n_touching, n_between_grains += !c.on_wall(), kn += c.kn;
  out.rattler_fraction = static_cast<double>(moduli.n_rattlers) / network.n_grains;
  out.z_star = n_held == 0 ? 0.0 : 2.0 * n_between_grains / n_held;
  if (n_touching > 0) {
    const double a = 2.0 * *std::max_element(network.grain_size.begin(), network.grain_size.end());
    out.G_star = moduli.G * std::pow(a, Dim - 2) / (kn / n_touching * solid_fraction(packing)) /
                 (1.0 - out.rattler_fraction);
  }
  out.n_dead_ends = moduli.response.free.n_dead_ends();
  out.n_components = moduli.response.free.n_components;
  out.indeterminacy = force_indeterminacy(network, moduli.response);
  if (contacts.isotropic) out.energy_share_95 = contacts.isotropic->energy_share_95;
  if (contacts.deviatoric) out.energy_share_95_deviatoric = contacts.deviatoric->energy_share_95;
  if (!contacts.backbone.empty()) out.backbone_share = share(contacts.backbone);
  if (!network.contacts.empty()) out.scalar_backbone_share = share(contacts.percolation.scalar_backbone);
  out.n_percolating = contacts.percolation.n_directions;
  return out;
}

#define FLOC_INSTANTIATE(Dim)                                                                                 \
  template ContactMechanics<Dim> contact_mechanics(const ContactNetwork<Dim>&, const Moduli&);                \
  template NetworkMechanics network_mechanics(const Packing<Dim>&, const ContactNetwork<Dim>&, const Moduli&, \
                                              const ContactMechanics<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
