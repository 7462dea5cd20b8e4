#pragma once

#include <Eigen/Dense>

#include "floc/network/contact_network.h"

namespace floc::test {

/// Computes the degree of indeterminacy from its definition: the number of force components minus the rank of a matrix,
/// which is the number of its singular values above 1e-8. The matrix maps force components to the net forces and
/// moments of the grains and to the stresses along the axes. Contacts whose elastic force is at most `smallest` are
/// left out.
/// @param tangential  whether tangential forces are included
template <int Dim>
int counted_indeterminacy(const Packing<Dim>& packing, bool tangential, double smallest = -1.0) {
  ContactNetwork<Dim> network = contact_network(packing);
  std::erase_if(network.contacts, [&](const NetworkContact<Dim>& c) {
    return !(packing.contacts[c.source].elastic_force > smallest);
  });
  const int n_each = tangential ? Dim : 1, n = n_each * static_cast<int>(network.contacts.size());
  Eigen::MatrixXd balance = Eigen::MatrixXd::Zero(kDofs<Dim> * network.n_grains + Dim, n);
  int column = 0;
  for (const NetworkContact<Dim>& c : network.contacts)
    for (int k = 0; k < n_each; ++k, ++column) {
      const Vec<Dim> force = c.frame.col(k);
      const auto act = [&](int grain, const Vec<Dim>& on, const Vec<Dim>& arm) {
        const int row = kDofs<Dim> * grain;
        for (int a = 0; a < Dim; ++a) balance(row + a, column) += on[a];
        if constexpr (Dim == 2) {
          balance(row + 2, column) += arm[0] * on[1] - arm[1] * on[0];
        } else {
          const Vec<3> moment = arm.cross(on);
          for (int a = 0; a < 3; ++a) balance(row + 3 + a, column) += moment[a];
        }
      };
      act(c.j, force, c.arm_j);
      act(c.i, -force, c.arm_i);
      for (int a = 0; a < Dim; ++a) balance(kDofs<Dim> * network.n_grains + a, column) = force[a] * c.branch[a];
    }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(balance);
  return n - static_cast<int>((svd.singularValues().array() > 1e-8).count());
}

}  // namespace floc::test
