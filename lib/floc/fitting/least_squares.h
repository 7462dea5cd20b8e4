#pragma once

#include <ceres/jet.h>

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

namespace floc {

/// A minimum of a sum of squares.
struct LeastSquaresSolution {
  Eigen::VectorXd theta;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  ///< residuals x parameters; empty when a parameter was held
  double sum_of_squares = 0.0;
};

/// Range that a parameter may not leave.
struct ParameterLimits {
  int parameter;
  double low, high;
};

/// Returns (J^T J)^-1, parameters x parameters. A parameter with a component along a direction that the data do
/// not determine has infinite variance.
[[nodiscard]] Eigen::MatrixXd unit_covariance(const Eigen::MatrixXd& jacobian);

/// Interface of the residuals of a problem, so that the solvers are compiled once for all problems.
class ResidualFunction {
 public:
  virtual ~ResidualFunction() = default;
  virtual int n_residuals() const = 0;
  virtual int n_parameters() const = 0;
  /// Computes the residuals and, if `jacobian` is not null, their derivatives.
  /// @param jacobian  residuals x parameters, row after row; may be null
  virtual void evaluate(const double* theta, double* values, double* jacobian) const = 0;
};

/// Minimises a sum of squares by Levenberg-Marquardt (Ceres), to rounding, from one start.
/// @param limits  ranges of the parameters that are limited
/// @param held    index of a parameter kept at its start; -1 for none
/// @return the minimum; absent if the solver fails
[[nodiscard]] std::optional<LeastSquaresSolution> minimize(const ResidualFunction& function,
                                                           const Eigen::VectorXd& start,
                                                           const std::vector<ParameterLimits>& limits = {},
                                                           int held = -1);

/// Minimises a sum of squares by normal equations (Ceres' TinySolver), ten times faster than minimize() and
/// accurate to half the digits. Used for searches among starts.
/// @param theta  the start; replaced by the end
/// @return the sum of squares reached, which may be NaN
double descend(const ResidualFunction& function, Eigen::VectorXd& theta);

/// Residuals with automatic derivatives.
/// @tparam Residual  has `kParameters` and `T operator()(const T* theta)` on any scalar
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
