#pragma once

#include "floc/base/lanes.h"
#include "floc/contact/capped_spring.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Friction of elastic spheres. The increment of the tangential force T is the slip times the tangential stiffness K_T
/// at the present normal force. T is capped at the friction coefficient mu times the elastic part FNe of the normal
/// force. If the normal force decreases, T decreases in proportion to K_T; if the normal force increases, T does not
/// change. With this rule, a contact cannot gain energy on a closed path of motion (docs/physics.md, "Spheres of Hertz
/// and Mindlin"). [AR2007], section II.
struct MindlinFriction {
  double coefficient;  ///< friction coefficient mu

  static constexpr const char* kKeyword = "mindlin";
  static constexpr Family kFamily = Family::elastic_spheres;
  static constexpr int kDimension = 3;
  static constexpr bool kFollowsNormalStiffness = true;
  static constexpr Number<MindlinFriction> kNumbers[] = {
      {"coefficient", &MindlinFriction::coefficient, Unit::ratio, "mu", Requirement::not_negative,
       "a number >= 0 (friction coefficient mu)", "friction coefficient"}};
  static constexpr History kHistory[] = {
      {"tangential_force", HistoryKind::tangent, Unit::force,
       "tangential force on grain id1, a vector in the tangent plane"},
      {"last_stiffness", HistoryKind::scalar, Unit::stiffness,
       "tangential stiffness K_T at which the tangential force was last updated"}};

  /// Updates the tangential force in the history after the slip of the contact during one step.
  /// @param history  tangential force and the stiffness K_T of its last update, as declared by kHistory
  /// @return tangential force on grain i (force)
  template <class T, class V>
  V respond(const PairGeometry<T>&, const NormalResponse<T>& normal, const V& slip, T* history) const {
    Eigen::Map<V> force(history);
    T& last = history[V::RowsAtCompileTime];
    const T stiffness = normal.shear_stiffness;
    const auto unloads = stiffness < last;
    const T scale = lanes::select(unloads, T(stiffness / lanes::select(unloads, last, T(1))), T(1));
    force = capped(V(force * scale + slip * stiffness), T(coefficient * normal.elastic));
    last = stiffness;
    return force;
  }
  template <class V>
  bool is_mobilised(double elastic, const double* history, double tolerance) const {
    return Eigen::Map<const V>(history).norm() >= (1.0 - tolerance) * (coefficient * elastic);
  }
  /// Sets the tangential force in the history, and sets the stiffness of its last update to zero. Because of this zero,
  /// the next update adds to the force and does not first reduce it.
  template <class V>
  void set_force(const V& force, double /*stiffness*/, double* history) const {
    Eigen::Map<V>{history} = force;
    history[V::RowsAtCompileTime] = 0.0;
  }
  /// Returns the tangential stiffness K_T (force/length) of a contact that touches and does not slide.
  double stiffness(const NormalResponse<double>& normal) const { return normal.shear_stiffness; }
  /// Returns whether the friction force can differ from zero. Otherwise friction is left out of the contact law,
  /// because it must not stiffen the elastic network of contacts.
  bool acts() const { return coefficient != 0.0; }

  bool operator==(const MindlinFriction&) const = default;
};

}  // namespace floc
