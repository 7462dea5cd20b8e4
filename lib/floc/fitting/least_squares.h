#pragma once

#include <ceres/jet.h>

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

namespace floc {

/// Minimum of a sum of squared residuals.
struct LeastSquaresSolution {
  Eigen::VectorXd theta;
  Eigen::VectorXd residuals;
  /// Derivatives of the residuals (residuals x parameters); empty if a parameter was held fixed.
  Eigen::MatrixXd jacobian;
  double sum_of_squares = 0.0;
};

/// Limits of one parameter in a minimisation.
struct ParameterLimits {
  int parameter;
  double low, high;
};

/// Returns (J^T J)^-1 of a Jacobian J (residuals x parameters). A parameter that the residuals do not determine
/// has infinite variance.
[[nodiscard]] Eigen::MatrixXd unit_covariance(const Eigen::MatrixXd& jacobian);

/// Returns an orthonormal basis of the space of the columns of a matrix, which may depend on each other.
[[nodiscard]] Eigen::MatrixXd basis_of(const Eigen::MatrixXd& columns);

/// Interface of the residuals of a least-squares problem, so that the solvers are compiled only once for all problems.
class ResidualFunction {
 public:
  virtual ~ResidualFunction() = default;
  virtual int n_residuals() const = 0;
  virtual int n_parameters() const = 0;
  /// Computes the residuals and, if `jacobian` is not null, their derivatives.
  /// @param jacobian  derivatives (residuals x parameters, in row-major order); may be null
  virtual void evaluate(const double* theta, double* values, double* jacobian) const = 0;
};

/// Minimises a sum of squares by Levenberg-Marquardt (Ceres) from one starting point. The minimum is exact to rounding.
/// @param limits  limits of some parameters; all other parameters have no limits
/// @param held    index of a parameter that is held fixed; -1 to fit all
/// @return the minimum; absent if the solver fails
[[nodiscard]] std::optional<LeastSquaresSolution> minimize(const ResidualFunction& function,
                                                           const Eigen::VectorXd& start,
                                                           const std::vector<ParameterLimits>& limits = {},
                                                           int held = -1);

/// Minimises a sum of squares by normal equations (Ceres' TinySolver). This solver compares many starting points: it is
/// ten times faster than minimize(), but only half of the digits of the result are accurate.
/// @param theta  the starting point; replaced by the minimum
/// @return the sum of squares reached, which may be NaN
double descend(const ResidualFunction& function, Eigen::VectorXd& theta);

/// Residuals whose derivatives are computed by automatic differentiation.
/// @tparam Residual type of one residual, with the number `kParameters` and `T operator()(const T* theta)` for
/// any scalar type T
template <class Residual>
class DifferentiatedResiduals final : public ResidualFunction {
 public:
  explicit DifferentiatedResiduals(const std::vector<Residual>& residuals) : residuals_(residuals) {}

  int n_residuals() const override { return static_cast<int>(residuals_.size()); }
  int n_parameters() const override { return kParameters; }
  void evaluate(const double* theta, double* values, double* jacobian) const override {
    if (jacobian == nullptr) {
      for (const Residual& residual : residuals_) *values++ = residual(theta);
      return;
    }
    using Jet = ceres::Jet<double, kParameters>;
    Jet at[kParameters];
    for (int k = 0; k < kParameters; ++k) at[k] = Jet(theta[k], k);
    for (const Residual& residual : residuals_) {
      const Jet value = residual(static_cast<const Jet*>(at));
      *values++ = value.a;
      jacobian = std::copy_n(value.v.data(), kParameters, jacobian);
    }
  }

 private:
  static constexpr int kParameters = Residual::kParameters;
  const std::vector<Residual>& residuals_;
};

template <class Residual>
[[nodiscard]] std::optional<LeastSquaresSolution> minimize(const std::vector<Residual>& residuals,
                                                           const Eigen::VectorXd& start,
                                                           const std::vector<ParameterLimits>& limits = {},
                                                           int held = -1) {
  return minimize(DifferentiatedResiduals<Residual>(residuals), start, limits, held);
}

template <class Residual>
double descend(const std::vector<Residual>& residuals, Eigen::VectorXd& theta) {
  return descend(DifferentiatedResiduals<Residual>(residuals), theta);
}

}  // namespace floc
