#include "floc/relaxation/free_strains.h"

namespace floc {

template <int Dim>
Mat<Dim> FreeStrains<Dim>::strain_of(const Eigen::VectorXd& step) const {
  Mat<Dim> strain = Mat<Dim>::Zero();
  for (int s = 0; s < size(); ++s) strain(axes[s][0], axes[s][1]) = step[step.size() - size() + s] / length;
  return strain;
}

template <int Dim>
BoundaryColumns<Dim> FreeStrains<Dim>::columns(const NetworkContact<Dim>& c) const {
  const Vec<Dim> on_i = c.shear_force - c.normal_force * c.normal();
  BoundaryColumns<Dim> out;
  out.displacement.setZero(Dim, size());
  out.follow.setZero(size(), Dim);
  for (int s = 0; s < size(); ++s) {
    const auto [along, by] = axes[s];
    out.displacement(along, s) = c.branch[by] / length;
    out.follow(s, by) = on_i[along] / length;
  }
  return out;
}

template <int Dim>
Eigen::MatrixXd FreeStrains<Dim>::load_derivatives(double volume) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size(), size());
  for (int p = 0; p < size(); ++p)
    for (int q = 0; q < size(); ++q)
      if (axes[q][0] == axes[q][1]) out(p, q) = volume * stress[p] / (length * length);
  return out;
}

template struct FreeStrains<2>;
template struct FreeStrains<3>;

}  // namespace floc
