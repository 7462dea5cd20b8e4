#include "floc/packing/law/contact_response.h"

#include <cassert>
#include <variant>

#include "floc/base/dual.h"
#include "floc/packing/law/law_response.h"

namespace floc {
namespace {

/// Factor by which springs are lengthened when derivatives are computed. A spring whose force equals its cap up to
/// rounding errors exceeds the cap after this lengthening, and counts as sliding.
constexpr double kBeyondCap = 1.0 + 2e-12;
/// Motion of the surfaces (length or radians) that is added when derivatives are computed. With this motion, a spring
/// of zero length exceeds a cap of zero, for example between surfaces that have separated. The motion is negligible
/// compared with any other motion, and its square does not underflow.
constexpr double kTinyMotion = 1e-150;

/// Calls visit(law, contact, k) for each contact, with the contact law between its bodies and its index k.
template <int Dim, class Contacts, class Visitor>
void for_each_with_law(const Packing<Dim>& packing, const Contacts& contacts, const Visitor& visit) {
  const AnyContactLaw wall_law = compose_law(packing.wall_law);
  // Defined outside the visitor below, so that it is compiled once and not once for each law between grains.
  const auto visit_on_wall = [&](std::size_t k) {
    std::visit([&](const auto& law) { visit(law, contacts[k], k); }, wall_law);
  };
  std::visit(
      [&](const auto& law) {
        for (std::size_t k = 0; k < contacts.size(); ++k)
          if (packing.is_wall(contacts[k].j))
            visit_on_wall(k);
          else
            visit(law, contacts[k], k);
      },
      compose_law(packing.law));
}

/// Returns the factor by which each number in the history of a contact is multiplied when derivatives are computed:
/// kBeyondCap for springs, 1 for other quantities.
template <int Dim>
ContactHistory<Dim> spring_factors(const Law& law) {
  ContactHistory<Dim> factor = ContactHistory<Dim>::Ones();
  for (const HistoryQuantity& q : history_quantities(law, Dim))
    if (q.declared.kind != HistoryKind::scalar) factor.segment(q.begin, q.size).setConstant(kBeyondCap);
  return factor;
}

/// Returns the history of a contact as dual numbers, for automatic differentiation.
template <class Law, int Dim>
PackedHistory<Law::template kHistorySize<Dim>, Dual<kDofs<Dim>>> dual_history(const ContactHistory<Dim>& all) {
  PackedHistory<Law::template kHistorySize<Dim>, Dual<kDofs<Dim>>> history;
  if constexpr (Law::template kHistorySize<Dim> != 0)
    for_each_history<Law, Dim>([&](auto k, auto place) { history.value[k] = Dual<kDofs<Dim>>(all[place]); });
  return history;
}

/// Returns the parameters of a pair of grains as dual numbers with zero derivatives, because motion does not change
/// these parameters.
template <class Law, class T>
typename Law::template PairParameters<T> constant(
    [[maybe_unused]] const typename Law::template PairParameters<>& parameters) {
  if constexpr (Law::kHoldsLiquid)
    return {T(parameters.strength), T(parameters.decay), T(parameters.reach)};
  else
    return {};
}

/// Returns the axes about which the grains of a contact roll on each other, as the columns of a matrix: one column for
/// each rotation in `ContactRows`. In 3D the first column belongs to the rotation about the normal, which is not
/// rolling, and is zero; the other columns are the two tangents.
Mat<1> rolling_axes(const Mat<2>&) {
  return Mat<1>::Identity();
}
Mat<3> rolling_axes(const Mat<3>& frame) {
  Mat<3> axes = frame;
  axes.col(0).setZero();
  return axes;
}

template <class Law, int Dim>
ContactTangent<Dim> tangent_of(const Law& law, const Grains<Dim>& grains, const Contact<Dim>& start,
                               const ContactHistory<Dim>& factor, const SurfaceMotion<Dim>& surface,
                               const Mat<Dim>& frame) {
  constexpr int n = kDofs<Dim>;
  using T = Dual<n>;
  Eigen::Matrix<double, kShearComponents<Dim>, Dim - 1> tangents;
  for (int t = 0; t < Dim - 1; ++t)
    tangents.col(t) = to_shear<double>(Vec<Dim>(frame.col(0)), Vec<Dim>(frame.col(t + 1)));

  const PairGeometry<> pair = pair_geometry(grains, start);
  ContactMotion<Dim, T> motion{{T(pair.gap), T(pair.reduced_radius), T(pair.reduced_mass)},
                               T(0),
                               T(0),
                               Shear<Dim, T>::Zero(),
                               RotationVector<Dim, T>::Zero()};
  motion.pair.gap.derivative[0] = -1.0;
  for (int a = 0; a < kShearComponents<Dim>; ++a) {
    motion.slip[a] = T(kBeyondCap * surface.slip[a] + kTinyMotion);
    for (int t = 0; t < Dim - 1; ++t) motion.slip[a].derivative[1 + t] = tangents(a, t);
  }
  const Mat<kRotations<Dim>> rolling = rolling_axes(frame);
  for (int a = 0; a < kRotations<Dim>; ++a) {
    motion.relative_rotation[a] = T(kBeyondCap * surface.relative_rotation[a] + kTinyMotion);
    for (int b = 0; b < kRotations<Dim>; ++b)
      motion.relative_rotation[a].derivative[Dim + b] = -rolling(a, b);  // the minus sign gives the rotation of
                                                                         // i relative to j
  }
  if constexpr (Dim == 3) {
    motion.twist = T(kBeyondCap * surface.twist + kTinyMotion);
    motion.twist.derivative[Dim] = -1.0;
  }
  auto history = dual_history<Law, Dim>(factor.cwiseProduct(start.history));
  const auto parameters = pair_parameters(law, grains, start, packed_history<Law, Dim>(start.history));
  const ContactForces<Dim, T> f = law.respond(motion, history, constant<Law, T>(parameters));

  ContactTangent<Dim> k = ContactTangent<Dim>::Zero();
  const T normal = f.normal.force();
  for (int b = 0; b < n; ++b) {
    k(0, b) = normal.derivative[b];
    for (int t = 0; t < Dim - 1; ++t)
      for (int a = 0; a < kShearComponents<Dim>; ++a) k(1 + t, b) += tangents(a, t) * f.shear[a].derivative[b];
    for (int c = 0; c < kRotations<Dim>; ++c)
      for (int a = 0; a < kRotations<Dim>; ++a) k(Dim + c, b) -= rolling(a, c) * f.rolling[a].derivative[b];
    if constexpr (Dim == 3) k(Dim, b) -= f.twisting.derivative[b];
  }
  return k;
}

}  // namespace

template <int Dim>
void transport_history(const std::vector<HistoryQuantity>& remembered, const Vec<Dim>& normal, double twist,
                       Contact<Dim>& contact, SurfaceMotion<Dim>& motion) {
  if constexpr (Dim == 3) {
    if (!contact.normal.isZero(0.0)) {
      const auto carried = [&](const Vec<3>& v) {
        return Vec<3>(transport<double>(v, contact.normal, normal, twist));
      };
      for (const HistoryQuantity& q : remembered)
        if (q.size == Dim)
          contact.history.template segment<Dim>(q.begin) =
              carried(contact.history.template segment<Dim>(q.begin));
      motion.slip = carried(motion.slip);
      motion.relative_rotation = carried(motion.relative_rotation);
    }
  }
  contact.normal = normal;
}

template <int Dim>
void respond(const Packing<Dim>& packing, std::span<const SurfaceMotion<Dim>> motion,
             std::span<Contact<Dim>> contacts) {
  assert(motion.size() == contacts.size());
  for_each_with_law(packing, contacts, [&](const auto& law, Contact<Dim>& contact, std::size_t k) {
    respond_to_motion(law, packing.grains, motion[k], contact);
  });
}

template <int Dim>
void contact_tangents(const Packing<Dim>& packing, std::span<const Contact<Dim>> start,
                      std::span<const SurfaceMotion<Dim>> motion, std::span<const Mat<Dim>> frame,
                      std::span<ContactTangent<Dim>> tangent) {
  assert(motion.size() == start.size() && frame.size() == start.size() && tangent.size() == start.size());
  const ContactHistory<Dim> between_grains = spring_factors<Dim>(packing.law);
  const ContactHistory<Dim> on_walls = spring_factors<Dim>(packing.wall_law);
  for_each_with_law(packing, start, [&](const auto& law, const Contact<Dim>& contact, std::size_t k) {
    const ContactHistory<Dim>& factor = packing.is_wall(contact.j) ? on_walls : between_grains;
    tangent[k] = tangent_of(law, packing.grains, contact, factor, motion[k], frame[k]);
  });
}

#define FLOC_INSTANTIATE(Dim)                                                                                  \
  template void transport_history(const std::vector<HistoryQuantity>&, const Vec<Dim>&, double, Contact<Dim>&, \
                                  SurfaceMotion<Dim>&);                                                        \
  template void respond(const Packing<Dim>&, std::span<const SurfaceMotion<Dim>>, std::span<Contact<Dim>>);    \
  template void contact_tangents(const Packing<Dim>&, std::span<const Contact<Dim>>,                           \
                                 std::span<const SurfaceMotion<Dim>>, std::span<const Mat<Dim>>,               \
                                 std::span<ContactTangent<Dim>>);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
