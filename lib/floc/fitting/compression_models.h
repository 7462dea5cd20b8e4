#pragma once

#include <cmath>

namespace floc {

// Each model is a compression law (CompressionLaw) in the form that the solver needs:
// - kParameters coordinates theta, chosen so that positive parameters are positive for any theta,
// - density(theta, P), the solid fraction at the pressure P,
// - kQuantities parameters with their names, and quantities(theta, q), the coordinates in which their intervals are
//   symmetric: the logarithm of a positive parameter, or the parameter itself where `kLogarithm` is false.
// In a model with D0, the first coordinate is ln D0; it is fixed if the user gives D0. T is any scalar type.

struct HeckelModel {
  static constexpr int kParameters = 2, kQuantities = 2;
  static constexpr const char* kNames[] = {"P_y", "A"};
  static constexpr bool kLogarithm[] = {true, false};
  static constexpr bool kHasD0 = false;
  template <class T>
  static T density(const T* theta, double P) {
    using std::exp;
    return T(1.0) - exp(-theta[1] - P * exp(-theta[0]));
  }
  template <class T>
  static void quantities(const T* theta, T* q) {
    q[0] = theta[0];
    q[1] = theta[1];
  }
};

/// theta = (ln D0, ln b, ln Phi_max), with a = 1 - D0/Phi_max
struct KawakitaModel {
  static constexpr int kParameters = 3, kQuantities = 4;
  static constexpr const char* kNames[] = {"a", "b", "D0", "Phi_max"};
  static constexpr bool kLogarithm[] = {true, true, true, true};
  static constexpr bool kHasD0 = true;
  static constexpr int kLimit = 2;  ///< index of the coordinate that is the limit of the solid fraction
  template <class T>
  static T density(const T* theta, double P) {
    using std::exp;
    const T bP = exp(theta[1]) * P;
    return exp(theta[0]) * (1.0 + bP) / (1.0 + bP * exp(theta[0] - theta[2]));
  }
  template <class T>
  static void quantities(const T* theta, T* q) {
    using std::expm1;
    using std::log;
    q[0] = log(-expm1(theta[0] - theta[2]));
    q[1] = theta[1];
    q[2] = theta[0];
    q[3] = theta[2];
  }
};

/// theta = (ln D0, ln k1, ln k2/k1, ln a1, ln a2)
struct CooperEatonModel {
  static constexpr int kParameters = 5, kQuantities = 5;
  static constexpr const char* kNames[] = {"a1", "k1", "a2", "k2", "D0"};
  static constexpr bool kLogarithm[] = {true, true, true, true, true};
  static constexpr bool kHasD0 = true;
  template <class T>
  static T density(const T* theta, double P) {
    using std::exp;
    const T D0 = exp(theta[0]);
    const T filled = exp(theta[3] - exp(theta[1]) / P) + exp(theta[4] - exp(theta[1] + theta[2]) / P);
    return D0 / (1.0 - (1.0 - D0) * filled);
  }
  template <class T>
  static void quantities(const T* theta, T* q) {
    q[0] = theta[3];
    q[1] = theta[1];
    q[2] = theta[4];
    q[3] = theta[1] + theta[2];
    q[4] = theta[0];
  }
};

/// theta = (ln slope, 1/D at the pressure 1)
struct WalkerModel {
  static constexpr int kParameters = 2, kQuantities = 2;
  static constexpr const char* kNames[] = {"slope", "D_1"};
  static constexpr bool kLogarithm[] = {true, true};
  static constexpr bool kHasD0 = false;
  template <class T>
  static T density(const T* theta, double P) {
    using std::exp;
    return 1.0 / (theta[1] - exp(theta[0]) * std::log(P));
  }
  template <class T>
  static void quantities(const T* theta, T* q) {
    using std::log;
    q[0] = theta[0];
    q[1] = -log(theta[1]);
  }
};

/// theta = (ln slope, D at the pressure 1)
struct GurnhamModel {
  static constexpr int kParameters = 2, kQuantities = 2;
  static constexpr const char* kNames[] = {"slope", "D_1"};
  static constexpr bool kLogarithm[] = {true, false};
  static constexpr bool kHasD0 = false;
  template <class T>
  static T density(const T* theta, double P) {
    using std::exp;
    return theta[1] + exp(theta[0]) * std::log(P);
  }
  template <class T>
  static void quantities(const T* theta, T* q) {
    q[0] = theta[0];
    q[1] = theta[1];
  }
};

/// theta = (ln D0, ln tau, ln alpha)
struct AdamsModel {
  static constexpr int kParameters = 3, kQuantities = 3;
  static constexpr const char* kNames[] = {"tau", "alpha", "D0"};
  static constexpr bool kLogarithm[] = {true, true, true};
  static constexpr bool kHasD0 = true;
  template <class T>
  static T density(const T* theta, double P) {
    using std::exp;
    using std::log;
    return exp(theta[0] + log(1.0 + P * exp(theta[2] - theta[1])) * exp(-theta[2]));
  }
  template <class T>
  static void quantities(const T* theta, T* q) {
    q[0] = theta[1];
    q[1] = theta[2];
    q[2] = theta[0];
  }
};

}  // namespace floc
