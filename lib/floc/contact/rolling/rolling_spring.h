#pragma once

#include "floc/contact/capped_spring.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Rolling resistance: a spring of stiffness K_R, to which the relative rotation of two grains is added step by step.
/// The moment of the spring is at most mu_R FNe, where mu_R is the coefficient of rolling friction (length) and FNe the
/// elastic part of the normal force. [GRC2007], section II.
struct RollingSpring {
  double coefficient;        ///< coefficient mu_R of rolling friction (length)
  double rolling_stiffness;  ///< rolling stiffness K_R (force * length)

  static constexpr const char* kKeyword = "spring";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsInEveryFile = true;
  static constexpr bool kIsDefault = true;
  static constexpr Number<RollingSpring> kNumbers[] = {
      {"coefficient", &RollingSpring::coefficient, Unit::length, "mu_R", Requirement::not_negative,
       "a number >= 0 (coefficient mu_R of rolling friction, a length)", "coefficient of rolling friction"},
      {"stiffness", &RollingSpring::rolling_stiffness, Unit::rolling_stiffness, "K_R", Requirement::positive,
       "a positive number (rolling stiffness K_R, force times length)", "rolling stiffness"}};
  static constexpr History kHistory[] = {
      {"rolling_spring", HistoryKind::rotation, Unit::angle,
       "rotation of the rolling spring: relative rotation of grain id1 against grain id2"}};

  /// Adds to the spring the relative rotation of the grains during one step, and shortens the spring if its moment
  /// exceeds the cap.
  /// @param history  rotation of the spring, as declared by kHistory
  /// @return rolling moment on grain j (force * length)
  template <class T, class V>
  V respond(const PairGeometry<T>&, const NormalResponse<T>& normal, const V& relative_rotation,
            T* history) const {
    return respond_capped(coefficient, rolling_stiffness, normal.elastic, relative_rotation, history);
  }
  template <class V>
  bool is_mobilised(double elastic, const double* history, double tolerance) const {
    return acts() && capped_is_mobilised<V>(coefficient, rolling_stiffness, elastic, history, tolerance);
  }
  /// Sets the history so that the spring exerts the moment `force` on grain j.
  /// @param stiffness  rolling stiffness of the contact, > 0
  template <class V>
  void set_force(const V& force, double stiffness, double* history) const {
    Eigen::Map<V>{history} = force / stiffness;
  }
  /// Returns the rolling stiffness K_R (force * length) of a touching contact whose rolling moment is below its cap; 0
  /// if the coefficient of rolling friction is zero.
  double stiffness(const NormalResponse<double>&) const { return acts() ? rolling_stiffness : 0.0; }
  /// Returns whether the moment of the spring can differ from zero. Otherwise the spring is left out of the contact
  /// law, because it must not stiffen the elastic network of contacts.
  bool acts() const { return coefficient != 0.0; }

  bool operator==(const RollingSpring&) const = default;
};

}  // namespace floc
