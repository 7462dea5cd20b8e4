#pragma once

#include "floc/contact/capped_spring.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Resistance of spheres to turning against each other about the normal of their contact: an incremental spring
/// K_tw on that rotation, with its moment capped at mu_tw FNe (elastic part only), whatever the rolling spring
/// carries.
struct TwistingSpring {
  double coefficient;         ///< mu_tw, a length
  double twisting_stiffness;  ///< K_tw (force * length)

  static constexpr const char* kKeyword = "spring";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsDefault = true;
  static constexpr int kDimension = 3;
  static constexpr Number<TwistingSpring> kNumbers[] = {
      {"coefficient", &TwistingSpring::coefficient, Unit::length, "mu_tw", Requirement::not_negative,
       "a number >= 0 (mu_tw, a length)", "twisting friction"},
      {"stiffness", &TwistingSpring::twisting_stiffness, Unit::rolling_stiffness, "K_tw", Requirement::positive,
       "a positive number (K_tw, force times length)", "twisting stiffness"}};
  static constexpr History kHistory[] = {
      {"twisting_spring", HistoryKind::twist, Unit::angle, "rotation of id1 against id2 about the normal"}};

  /// Adds the twist of one motion to the spring.
  /// @param history  as declared
  /// @return moment on j about the normal (force * length)
  template <class T>
  T respond(const NormalResponse<T>& normal, const T& twist, T* history) const {
    using One = Eigen::Matrix<T, 1, 1>;
    return respond_capped(coefficient, twisting_stiffness, normal.elastic, One(twist), history)[0];
  }
  bool is_mobilised(double elastic, const double* history, double tolerance) const {
    return capped_is_mobilised<Eigen::Matrix<double, 1, 1>>(coefficient, twisting_stiffness, elastic, history,
                                                            tolerance);
  }
  /// Sets the history so that it carries a moment on j.
  /// @param stiffness  K_tw of the contact, > 0
  void set_force(double moment, double stiffness, double* history) const { *history = moment / stiffness; }
  /// K_tw of a contact that touches and is not mobilised (force * length).
  double stiffness(const NormalResponse<double>&) const { return twisting_stiffness; }
  /// Whether the spring can carry a moment. One that cannot is left out, so that it does not stiffen the
  /// network.
  bool acts() const { return coefficient != 0.0; }

  bool operator==(const TwistingSpring&) const = default;
};

}  // namespace floc
