#include "floc/elasticity/indeterminacy.h"

#include <algorithm>

#include "floc/elasticity/mechanisms.h"

namespace floc {

template <int Dim>
Indeterminacy force_indeterminacy(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                  StrainSet strains) {
  Indeterminacy out;
  std::vector<bool> connected(network.n_grains, false);
  for (const NetworkContact<Dim>& c : network.contacts) {
    out.n_components += static_cast<int>((row_stiffness(c).array() != 0.0).count());
    connected[c.i] = connected[c.j] = true;
  }
  const int n_boundary = n_strains<Dim>(strains);
  const Eigen::MatrixXd relaxed = response.relaxed.topLeftCorner(n_boundary, n_boundary);
  const auto n_coupled =
      static_cast<int>(vanishing_strains(relaxed, affine_stiffness(network, strains)).cols());
  const FreeMotions& free = response.free;
  out.n_unknowns = kDofs<Dim> * static_cast<int>(std::count(connected.begin(), connected.end(), true)) +
                   n_boundary_unknowns(network, strains);
  out.n_null_modes = static_cast<int>(free.kind.size()) - free.count(FreeMotionKind::rattler) +
                     response.n_mechanisms + response.n_free_shifts + n_coupled;
  out.degree = out.n_components - out.n_unknowns + out.n_null_modes;
  return out;
}

template Indeterminacy force_indeterminacy(const ContactNetwork<2>&, const ElasticResponse&, StrainSet);
template Indeterminacy force_indeterminacy(const ContactNetwork<3>&, const ElasticResponse&, StrainSet);

}  // namespace floc
