#include "floc/network/geometric_springs.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <optional>

#include "floc/packing/locate.h"
#include "floc/shape/plane_manifold.h"

namespace floc {
namespace {

/// Length of the motions for the central differences, divided by the smaller outer radius; also the angle of the
/// rotations. With this value, rounding errors of a gap (about 1e-16 of the radius) change the stiffness by 1e-10 K_N.
constexpr double kMove = 1e-6;
/// Margin by which the gap along other features has to be larger during these motions, divided by kMove and the larger
/// outer radius. A rotation by kMove changes the difference of two such gaps by at most kMove times the sum of the
/// outer radii.
constexpr double kHold = 4.0;
/// Largest distance between a contact point of the packing and the point of the same pair that stands for it if no
/// point has its key, divided by the smaller outer radius.
constexpr double kSamePlace = 1e-3;

/// Displacement of grain j relative to grain i, and rotations of i and of j.
template <int Dim>
using Motion = Eigen::Matrix<double, kMotionRows<Dim>, 1>;

/// Geometry of a contact, or the derivative of the geometry with respect to a component of the motion of its grains.
template <int Dim>
struct GeometryChange {
  Vec<Dim> normal = Vec<Dim>::Zero();
  double gap = 0.0;
  Vec<Dim> arm_i = Vec<Dim>::Zero();
};

Mat<2> rotation_by(const RotationVector<2>& angle) {
  return Eigen::Rotation2Dd(angle[0]).toRotationMatrix();
}
Mat<3> rotation_by(const RotationVector<3>& angle) {
  const double size = angle.norm();
  if (size == 0.0) return Mat<3>::Identity();
  return Eigen::AngleAxisd(size, angle / size).toRotationMatrix();
}

/// Contact of two grains with corners, or of such a grain and a wall, whose bodies are moved by small amounts.
template <int Dim>
class MovedContact {
 public:
  MovedContact(const Packing<Dim>& packing, const Contact<Dim>& contact)
      : contact_(contact),
        first_(packing.grains.placed(contact.i)),
        reach_(first_.outer_radius()),
        options_(manifold_options(packing)) {
    if (packing.is_wall(contact.j)) {
      wall_ = packing.wall(contact.j);
      find_key();
      return;
    }
    second_ = packing.grains.placed(contact.j);
    second_.position = first_.position + branch(packing, contact);
    reach_ += second_.outer_radius();
    features_ = axis_features(static_cast<std::uint32_t>(contact.key), *first_.shape, *second_.shape);
    if (features_.kind == AxisKind::kNone) contact_manifold(first_, second_, reach_, &features_, options_);
    options_.least_margin = kHold * kMove * std::max(first_.outer_radius(), second_.outer_radius());
    find_key();
  }

  /// Returns the radius of the smaller grain of the contact (length).
  double smaller_radius() const {
    return wall_ ? reach_ : std::min(first_.outer_radius(), second_.outer_radius());
  }

  /// Returns the derivative of the geometry with respect to one component of the motion. The grains are moved forwards
  /// and backwards. If the contact point exists after only one of these motions, because an edge leaves a face at the
  /// point, the difference is one-sided. If it exists after neither, there is no derivative.
  /// @param size  value of the component (length, or angle for a rotation)
  std::optional<GeometryChange<Dim>> change(int component, double size) const {
    const Motion<Dim> motion = size * Motion<Dim>::Unit(component);
    std::optional<GeometryChange<Dim>> after = moved(motion), before = moved(-motion);
    const double span = (after ? size : 0.0) + (before ? size : 0.0);
    if (span == 0.0) return std::nullopt;
    const GeometryChange<Dim> present{contact_.normal, contact_.gap, contact_.arm_i};
    const GeometryChange<Dim> to = after.value_or(present), from = before.value_or(present);
    return GeometryChange<Dim>{(to.normal - from.normal) / span, (to.gap - from.gap) / span,
                               (to.arm_i - from.arm_i) / span};
  }

 private:
  /// Sets the key of the point that is followed: the key of the contact or, if no point of the unmoved grains has it,
  /// that of the point in the same place. Programs other than floc may write other keys.
  void find_key() {
    key_ = static_cast<std::uint32_t>(contact_.key);
    const Manifold<Dim> present = manifold_after(Motion<Dim>::Zero());
    if (present.with_key(key_)) return;
    const ManifoldPoint<Dim>* nearest = present.nearest(contact_.arm_i);
    if (nearest && (nearest->arm - contact_.arm_i).norm() <= kSamePlace * smaller_radius()) key_ = nearest->key;
  }

  /// Returns the geometry of the contact after a motion of its grains; nothing if no point has the key of the contact.
  std::optional<GeometryChange<Dim>> moved(const Motion<Dim>& motion) const {
    const Manifold<Dim> manifold = manifold_after(motion);
    const ManifoldPoint<Dim>* point = manifold.with_key(key_);
    if (!point) return std::nullopt;
    return GeometryChange<Dim>{manifold.normal, point->gap, point->arm};
  }

  /// Returns the contact points after a motion of the bodies.
  Manifold<Dim> manifold_after(const Motion<Dim>& motion) const {
    const Vec<Dim> displacement = motion.template head<Dim>();
    const RotationVector<Dim> turn_i = motion.template segment<kRotations<Dim>>(Dim);
    const RotationVector<Dim> turn_j = motion.template tail<kRotations<Dim>>();
    PlacedShape<Dim> first = first_;
    first.rotation = rotation_by(turn_i) * first.rotation;
    if (wall_) {
      const Vec<Dim> normal = wall_->normal();
      return plane_manifold<Dim>(first, normal, wall_->side * wall_->position + normal.dot(displacement),
                                 reach_);
    }
    PlacedShape<Dim> second = second_;
    second.position += displacement;
    second.rotation = rotation_by(turn_j) * second.rotation;
    AxisFeatures features = features_;
    return contact_manifold(first, second, reach_, &features, options_);
  }

  const Contact<Dim>& contact_;
  PlacedShape<Dim> first_;
  PlacedShape<Dim> second_;  // not used if the second body is a wall
  std::optional<Wall<Dim>> wall_;
  double reach_;
  ManifoldOptions options_;
  AxisFeatures features_;
  std::uint32_t key_ = 0;
};

}  // namespace

// Let f = -F n + S be the force on i, with the normal n, the normal force F and the tangential force S. Let a_i and a_j
// be the lever arms. If j is displaced by dr relative to i, and the grains rotate, the normal changes by dn, the arms
// change by da_i and da_j = da_i - dr, and the gap changes by dg. The stiffness K_N of the contact point describes only
// a part of dg, n.u, with the relative displacement u of the points in contact. The rest of dg changes F by
// dF = -K_N (dg - n.u). With the mean rotation w of the grains, dS = w x S - n (n.(w x S) + S.dn). Then
//
//   df = -dF n - F dn + dS,  d(moment on i) = da_i x f + a_i x df,  d(moment on j) = -(da_j x f + a_j x df)
template <int Dim>
MotionMatrix<Dim> geometric_stiffness(const Packing<Dim>& packing, const NetworkContact<Dim>& c) {
  const MovedContact<Dim> moved(packing, packing.contacts[static_cast<std::size_t>(c.source)]);
  const Vec<Dim> n = c.normal();
  const Vec<Dim> force = c.shear_force - c.normal_force * n;
  const double length = kMove * moved.smaller_radius();
  MotionMatrix<Dim> k;
  for (int a = 0; a < kMotionRows<Dim>; ++a) {
    const Motion<Dim> unit = Motion<Dim>::Unit(a);
    const Vec<Dim> displacement = unit.template head<Dim>();
    const RotationVector<Dim> turn_i = unit.template segment<kRotations<Dim>>(Dim);
    const RotationVector<Dim> turn_j = unit.template tail<kRotations<Dim>>();
    const Vec<Dim> approach = displacement + cross<double>(turn_j, c.arm_j) - cross<double>(turn_i, c.arm_i);
    // Without a derivative, the geometry counts as fixed, and the gap changes by the approach alone.
    const GeometryChange<Dim> d =
        moved.change(a, a < Dim ? length : kMove)
            .value_or(GeometryChange<Dim>{Vec<Dim>::Zero(), n.dot(approach), Vec<Dim>::Zero()});
    const double normal_force = c.kn * (n.dot(approach) - d.gap);
    const Vec<Dim> turned = cross<double>(RotationVector<Dim>(0.5 * (turn_i + turn_j)), c.shear_force);
    const Vec<Dim> change = -normal_force * n - c.normal_force * d.normal + turned -
                            n * (n.dot(turned) + c.shear_force.dot(d.normal));
    const Vec<Dim> arm_j = d.arm_i - displacement;
    // The displacement of j does work on the force on j, which is -f.
    k.col(a) << change, -(moment<double>(d.arm_i, force) + moment<double>(c.arm_i, change)),
        moment<double>(arm_j, force) + moment<double>(c.arm_j, change);
  }
  return k;
}

template <int Dim>
std::vector<GeometricSprings<Dim>> geometric_springs(const Packing<Dim>& packing) {
  assert(!packing.grains.are_round());
  const ContactNetwork<Dim> network = contact_network(packing);
  std::vector<GeometricSprings<Dim>> springs;
  springs.reserve(network.contacts.size());
  for (const NetworkContact<Dim>& c : network.contacts) {
    const MotionMatrix<Dim> k = geometric_stiffness(packing, c);
    const Eigen::SelfAdjointEigenSolver<MotionMatrix<Dim>> modes(0.5 * (k + k.transpose()));
    springs.push_back({modes.eigenvectors(), modes.eigenvalues()});
  }
  return springs;
}

template <int Dim>
ContactRows<Dim> geometric_rows(const NetworkContact<Dim>& c, const GeometricSprings<Dim>& springs, int first) {
  const int n = std::min(kDofs<Dim>, kMotionRows<Dim> - first);
  const auto directions = springs.directions.middleCols(first, n).transpose();
  const GrainMotions<Dim> motions = grain_motions(c, 1.0, 1.0);
  ContactRows<Dim> rows{};
  rows.on_i.setZero();
  rows.on_j.setZero();
  rows.on_strain.setZero();
  rows.on_wall.setZero();
  rows.on_i.topRows(n) = directions * motions.on_i;
  rows.on_j.topRows(n) = directions * motions.on_j;
  // A strain E displaces j relative to i by -E branch and rotates no grain.
  for (int e = 0; e < kSymmetric<Dim>; ++e)
    rows.on_strain.col(e).head(n) = -directions.template leftCols<Dim>() * (unit_strain<Dim>(e) * c.branch);
  if (c.on_wall())
    rows.on_wall.topRows(n) = directions.template leftCols<Dim>() * c.normal() * c.normal().transpose();
  return rows;
}

template <int Dim>
RowStiffness<Dim> geometric_row_stiffness(const GeometricSprings<Dim>& springs, int first) {
  const int n = std::min(kDofs<Dim>, kMotionRows<Dim> - first);
  RowStiffness<Dim> stiffness = RowStiffness<Dim>::Zero();
  stiffness.head(n) = springs.stiffness.segment(first, n);
  return stiffness;
}

#define FLOC_INSTANTIATE(Dim)                                                                              \
  template MotionMatrix<Dim> geometric_stiffness(const Packing<Dim>&, const NetworkContact<Dim>&);         \
  template std::vector<GeometricSprings<Dim>> geometric_springs(const Packing<Dim>&);                      \
  template ContactRows<Dim> geometric_rows(const NetworkContact<Dim>&, const GeometricSprings<Dim>&, int); \
  template RowStiffness<Dim> geometric_row_stiffness(const GeometricSprings<Dim>&, int);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
