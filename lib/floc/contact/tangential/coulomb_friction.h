#pragma once

#include "floc/contact/capped_spring.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Coulomb friction: a tangential spring of stiffness K_T, to which the slip of the contact is added step by step. The
/// force of the spring is capped at the friction coefficient mu times the elastic part FNe of the normal force. The cap
/// does not depend on the adhesive part of the normal force, so the tangential force of a contact with zero normal
/// force can still be as large as mu F0, where F0 is the pull-off force. [GRC2008], Eq. 4; the printed equation lacks
/// the factor mu for a sliding contact.
struct CoulombFriction {
  double coefficient;           ///< friction coefficient mu
  double tangential_stiffness;  ///< tangential stiffness K_T (force/length)

  static constexpr const char* kKeyword = "coulomb";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsInEveryFile = true;
  static constexpr bool kIsDefault = true;
  static constexpr Number<CoulombFriction> kNumbers[] = {
      {"coefficient", &CoulombFriction::coefficient, Unit::ratio, "mu", Requirement::not_negative,
       "a number >= 0 (friction coefficient mu)", "friction coefficient"},
      {"stiffness", &CoulombFriction::tangential_stiffness, Unit::stiffness, "K_T", Requirement::positive,
       "a positive number (tangential stiffness K_T, force per length)", "tangential stiffness"}};
  static constexpr History kHistory[] = {{"shear_spring", HistoryKind::tangent, Unit::length,
                                          "elongation of the tangential spring; in 2D along the normal turned "
                                          "by +90 degrees, in 3D a vector in the "
                                          "tangent plane"}};

  /// Adds to the spring the slip of the contact during one step, and shortens the spring if its force exceeds the cap.
  /// @param history  elongation of the spring, as declared by kHistory
  /// @return tangential force on grain i (force)
  template <class T, class V>
  V respond(const PairGeometry<T>&, const NormalResponse<T>& normal, const V& slip, T* history) const {
    return respond_capped(coefficient, tangential_stiffness, normal.elastic, slip, history);
  }
  template <class V>
  bool is_mobilised(double elastic, const double* history, double tolerance) const {
    return capped_is_mobilised<V>(coefficient, tangential_stiffness, elastic, history, tolerance);
  }
  /// Sets the history so that the spring exerts the tangential force `force` on grain i.
  /// @param stiffness  tangential stiffness of the contact, > 0
  template <class V>
  void set_force(const V& force, double stiffness, double* history) const {
    Eigen::Map<V>{history} = force / stiffness;
  }
  /// Returns the tangential stiffness K_T (force/length) of a contact that touches and does not slide.
  double stiffness(const NormalResponse<double>&) const { return tangential_stiffness; }
  /// Returns whether the force of the spring can differ from zero. Otherwise the spring is left out of the contact law,
  /// because it must not stiffen the elastic network of contacts.
  bool acts() const { return coefficient != 0.0; }

  bool operator==(const CoulombFriction&) const = default;
};

}  // namespace floc
