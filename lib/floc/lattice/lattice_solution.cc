#include "floc/lattice/lattice_solution.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// Copies the forces of one element from its springs to the solution: the normal force; if the element resists shear,
/// the tangential forces; and if it resists bending, the moments about its axes of rotation (in 3D without the normal).
template <int Dim>
void read_element(const RelaxedSprings<Dim>& springs, const LatticeNetwork<Dim>& network, int e,
                  LatticeSolution<Dim>& out) {
  int row = springs.first_row()[e];
  const int end = springs.first_row()[e + 1];
  out.open[e] = springs.open(row);
  out.normal_force[e] = springs.force(row++);
  if (row == end) return;
  const Mat<Dim> frame = contact_frame(Vec<Dim>(network.elements[e].branch.normalized()));
  for (int a = 1; a < Dim; ++a) out.shear_force[e] += springs.force(row++) * frame.col(a);
  const Mat<kRotations<Dim>> axes = rotation_axes(frame);
  for (int a = kRotations<Dim> - (Dim - 1); row < end; ++a) out.moment[e] += springs.force(row++) * axes.col(a);
}

}  // namespace

template <int Dim>
int measured_component(const LatticeLoad<Dim>& load, int axis) {
  int largest = 0;
  const double size = load.value.cwiseAbs().maxCoeff(&largest);
  /// Smallest share of the largest component of a load that counts as a load.
  constexpr double kSmallest = 1e-6;
  return std::abs(load.value[axis]) > kSmallest * size ? axis : largest;
}

template <int Dim>
int LatticeSolution<Dim>::n_open() const {
  return static_cast<int>(std::count(open.begin(), open.end(), true));
}

template <int Dim>
Vec<Dim> LatticeSolution<Dim>::force_on_i(const LatticeNetwork<Dim>& network, int element) const {
  Vec<Dim> force = -normal_force[element] * network.elements[element].branch.normalized();
  if (!shear_force.empty()) force += shear_force[element];
  return force;
}

template <int Dim>
LatticeSolver<Dim>::LatticeSolver(const LatticeNetwork<Dim>& network, const RelaxationSettings& settings,
                                  LatticeBoundary boundary, int axis)
    : network_(network), boundary_(boundary), axis_(axis), springs_(relaxed_springs(network, settings)) {}

template <int Dim>
LatticeSolution<Dim> LatticeSolver<Dim>::solve(const LatticeLoad<Dim>& load) {
  StrainControl<Dim> control{load.imposed, load.value};
  if (boundary_ == LatticeBoundary::plates || boundary_ == LatticeBoundary::bonded_plates)
    for (int a = 0; a < kSymmetric<Dim>; ++a)
      if (a != axis_)
        // between plates, the nodes move freely sideways, so no uniform strain across the axis of the plates is needed:
        // these strains are fixed at zero
        control.imposed[a] = true, control.value[a] = 0.0;
  for (int a = 0; a < kSymmetric<Dim>; ++a)
    if (!control.imposed[a]) control.value[a] *= network_.volume;
  LatticeSolution<Dim> out;
  out.report = springs_->relax(control);
  const std::size_t n = network_.elements.size();
  out.strain = springs_->strain();
  out.stress = springs_->load() / network_.volume;
  out.energy = springs_->energy();
  out.normal_force.assign(n, 0.0);
  out.open.assign(n, false);
  if (!network_.central()) {
    out.shear_force.assign(n, Vec<Dim>::Zero());
    out.moment.assign(n, RotationVector<Dim>::Zero());
  }
  for (int e = 0; e < static_cast<int>(n); ++e) read_element(*springs_, network_, e, out);
  for (int k = 0; k < network_.n_nodes; ++k) out.displacement.push_back(springs_->displacement(k));
  return out;
}

template <int Dim>
Eigen::MatrixXd LatticeSolver<Dim>::moduli() {
  return springs_->tangent_stiffness() / network_.volume;
}

template int measured_component(const LatticeLoad<2>&, int);
template int measured_component(const LatticeLoad<3>&, int);
template struct LatticeSolution<2>;
template struct LatticeSolution<3>;
template class LatticeSolver<2>;
template class LatticeSolver<3>;

}  // namespace floc
