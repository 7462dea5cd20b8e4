#pragma once

#include "floc/contact/capped_spring.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Resistance of spheres to relative rotation about the normal of their contact: a spring of stiffness K_tw, to which
/// this rotation is added step by step. The moment of the spring is at most mu_tw FNe, where mu_tw is the coefficient
/// of twisting friction (length) and FNe the elastic part of the normal force. This cap does not depend on the rolling
/// spring.
struct TwistingSpring {
  double coefficient;         ///< coefficient mu_tw of twisting friction (length)
  double twisting_stiffness;  ///< twisting stiffness K_tw (force * length)

  static constexpr const char* kKeyword = "spring";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsDefault = true;
  static constexpr int kDimension = 3;
  static constexpr Number<TwistingSpring> kNumbers[] = {
      {"coefficient", &TwistingSpring::coefficient, Unit::length, "mu_tw", Requirement::not_negative,
       "a number >= 0 (coefficient mu_tw of twisting friction, a length)", "coefficient of twisting friction"},
      {"stiffness", &TwistingSpring::twisting_stiffness, Unit::rolling_stiffness, "K_tw", Requirement::positive,
       "a positive number (twisting stiffness K_tw, force times length)", "twisting stiffness"}};
  static constexpr History kHistory[] = {
      {"twisting_spring", HistoryKind::twist, Unit::angle,
       "rotation of the twisting spring: rotation of grain id1 against grain id2 about the normal"}};

  /// Adds to the spring the twist of the grains during one step, and shortens the spring if its moment exceeds the cap.
  /// @param history  rotation of the spring, as declared by kHistory
  /// @return twisting moment on grain j about the normal (force * length)
  template <class T>
  T respond(const NormalResponse<T>& normal, const T& twist, T* history) const {
    using One = Eigen::Matrix<T, 1, 1>;
    return respond_capped(coefficient, twisting_stiffness, normal.elastic, One(twist), history)[0];
  }
  bool is_mobilised(double elastic, const double* history, double tolerance) const {
    return capped_is_mobilised<Eigen::Matrix<double, 1, 1>>(coefficient, twisting_stiffness, elastic, history,
                                                            tolerance);
  }
  /// Sets the history so that the spring exerts the moment `moment` on grain j about the normal.
  /// @param stiffness  twisting stiffness of the contact, > 0
  void set_force(double moment, double stiffness, double* history) const { *history = moment / stiffness; }
  /// Returns the twisting stiffness K_tw (force * length) of a touching contact whose twisting moment is below its cap.
  double stiffness(const NormalResponse<double>&) const { return twisting_stiffness; }
  /// Returns whether the moment of the spring can differ from zero. Otherwise the spring is left out of the contact
  /// law, because it must not stiffen the elastic network of contacts.
  bool acts() const { return coefficient != 0.0; }

  bool operator==(const TwistingSpring&) const = default;
};

}  // namespace floc
