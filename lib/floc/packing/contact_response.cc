#include "floc/packing/contact_response.h"

#include <cassert>
#include <variant>

#include "floc/base/dual.h"
#include "floc/contact/law_table.h"

namespace floc {
namespace {

/// Springs are at their cap when shortening by rounding could not be told from reaching it.
constexpr double kAtCap = 1.0 - 1e-12;
/// Derivatives are taken with springs longer by twice that: those at their cap are then beyond it.
constexpr double kBeyondCap = 1.0 + 2e-12;
/// And with surfaces that have moved by this, which is lost in any other motion: a spring of length zero under a cap of zero
/// (surfaces that have parted) is beyond its cap then. The square of it is no underflow.
constexpr double kHardlyMoved = 1e-150;

template <class T, class Law, int Dim>
ContactHistory<Law, Dim, T> remembered(const Contact<Dim>& c, double stretched_by) {
  ContactHistory<Law, Dim, T> history;
  if constexpr (Law::kHasFriction) history.shear = (stretched_by * c.shear_spring).template cast<T>();
  if constexpr (Law::kHasRolling) history.roll = (stretched_by * c.rolling_spring).template cast<T>();
  return history;
}

template <class Law, int Dim>
void respond_one(const Law& law, const SurfaceMotion<Dim>& surface, Contact<Dim>& c) {
  auto history = remembered<double, Law, Dim>(c, 1.0);
  const ContactMotion<Dim> motion{c.gap, 0.0, 0.0, surface.slip, surface.relative_turn};
  const ContactForces<Dim> f = law.respond(motion, history);
  c.normal_force = f.normal.force();
  c.elastic_force = f.normal.elastic;
  c.shear_force = from_shear<double>(c.normal, f.shear);
  c.rolling_moment = -f.rolling;
  const ContactStiffness k = law.stiffness(c.gap);
  c.kn = k.normal;
  c.kt = k.tangential;
  c.kr = k.rolling;
  c.distant = c.gap >= 0.0;
  c.sliding = c.rolling_yield = false;
  c.shear_spring.setZero();
  c.rolling_spring.setZero();
  if constexpr (Law::kHasFriction) {
    c.shear_spring = history.shear;
    c.sliding = !c.distant && history.shear.norm() >= kAtCap * law.friction.spring_limit(c.elastic_force);
  }
  if constexpr (Law::kHasRolling) {
    c.rolling_spring = history.roll;
    c.rolling_yield = !c.distant && history.roll.norm() >= kAtCap * law.rolling.spring_limit(c.elastic_force);
  }
}

template <class Law, int Dim>
ContactTangent<Dim> tangent_of(const Law& law, const Contact<Dim>& start, const SurfaceMotion<Dim>& surface,
                               const Mat<Dim>& frame) {
  constexpr int n = kDofs<Dim>;
  using T = Dual<n>;
  Eigen::Matrix<double, kShearComponents<Dim>, Dim - 1> tangents;
  for (int t = 0; t < Dim - 1; ++t)
    tangents.col(t) = to_shear<double>(Vec<Dim>(frame.col(0)), Vec<Dim>(frame.col(t + 1)));

  ContactMotion<Dim, T> motion{T(start.gap), T(0), T(0), Shear<Dim, T>::Zero(), Spin<Dim, T>::Zero()};
  motion.gap.derivative[0] = -1.0;
  for (int a = 0; a < kShearComponents<Dim>; ++a) {
    motion.slip[a] = T(kBeyondCap * surface.slip[a] + kHardlyMoved);
    for (int t = 0; t < Dim - 1; ++t) motion.slip[a].derivative[1 + t] = tangents(a, t);
  }
  for (int a = 0; a < kRotations<Dim>; ++a) {
    motion.relative_turn[a] = T(kBeyondCap * surface.relative_turn[a] + kHardlyMoved);
    motion.relative_turn[a].derivative[Dim + a] = -1.0;  // of i against j
  }
  auto history = remembered<T, Law, Dim>(start, kBeyondCap);
  const ContactForces<Dim, T> f = law.respond(motion, history);

  ContactTangent<Dim> k = ContactTangent<Dim>::Zero();
  const T normal = f.normal.force();
  for (int b = 0; b < n; ++b) {
    k(0, b) = normal.derivative[b];
    for (int t = 0; t < Dim - 1; ++t)
      for (int a = 0; a < kShearComponents<Dim>; ++a) k(1 + t, b) += tangents(a, t) * f.shear[a].derivative[b];
    for (int a = 0; a < kRotations<Dim>; ++a) k(Dim + a, b) = -f.rolling[a].derivative[b];
  }
  return k;
}

}  // namespace

template <int Dim>
void carry(const Vec<Dim>& normal, double twist, Contact<Dim>& contact, SurfaceMotion<Dim>& motion) {
  if constexpr (Dim == 3) {
    if (!contact.normal.isZero(0.0)) {
      const auto carried = [&](const Vec<3>& v) {
        return Vec<3>(transport<double>(v, contact.normal, normal, twist));
      };
      contact.shear_spring = carried(contact.shear_spring);
      contact.rolling_spring = carried(contact.rolling_spring);
      motion.slip = carried(motion.slip);
      motion.relative_turn = carried(motion.relative_turn);
    }
  }
  contact.normal = normal;
}

template <int Dim>
void respond(const LawParameters& law, std::span<const SurfaceMotion<Dim>> motion,
             std::span<Contact<Dim>> contacts) {
  assert(motion.size() == contacts.size());
  std::visit(
      [&](const auto& composed) {
        for (std::size_t k = 0; k < contacts.size(); ++k) respond_one(composed, motion[k], contacts[k]);
      },
      compose_law(law));
}

template <int Dim>
void contact_tangents(const LawParameters& law, std::span<const Contact<Dim>> start,
                      std::span<const SurfaceMotion<Dim>> motion, std::span<const Mat<Dim>> frame,
                      std::span<ContactTangent<Dim>> tangent) {
  assert(motion.size() == start.size() && frame.size() == start.size() && tangent.size() == start.size());
  std::visit(
      [&](const auto& composed) {
        for (std::size_t k = 0; k < start.size(); ++k)
          tangent[k] = tangent_of(composed, start[k], motion[k], frame[k]);
      },
      compose_law(law));
}

#define FLOC_INSTANTIATE(Dim)                                                                                \
  template void carry(const Vec<Dim>&, double, Contact<Dim>&, SurfaceMotion<Dim>&);                          \
  template void respond(const LawParameters&, std::span<const SurfaceMotion<Dim>>, std::span<Contact<Dim>>); \
  template void contact_tangents(const LawParameters&, std::span<const Contact<Dim>>,                        \
                                 std::span<const SurfaceMotion<Dim>>, std::span<const Mat<Dim>>,             \
                                 std::span<ContactTangent<Dim>>);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
