#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/rigid/interior_point.h"
#include "floc/rigid/second_order_cone.h"

namespace floc {
namespace {

/// Largest number of Newton steps.
constexpr int kMostNewtonSteps = 8;
/// A solution is accepted if it satisfies all equations and inequalities up to this error, in the units of the program.
constexpr double kViolation = 1e-9;

/// Face of the cone on which the solution of a block lies.
enum class Face {
  interior,  ///< z = 0: the contact sticks
  surface,   ///< x and z lie on opposite rays of the surface: the contact slides
  apex,      ///< x = 0: the contact has no force
};

/// Returns the face of the cone on which x lies. Let x_- <= x_+ be the eigenvalues of x, and z_- <= z_+ those of z. In
/// a solution, one number of the pair (x_-, z_+) is zero, and one number of the pair (x_+, z_-) is zero. The smaller
/// number of each pair is taken to be zero.
template <int Dim>
Face face_of(const Vec<Dim>& x, const Vec<Dim>& z) {
  const double tx = x.template tail<Dim - 1>().norm(), tz = z.template tail<Dim - 1>().norm();
  if (x[0] - tx > z[0] + tz) return Face::interior;
  if (x[0] + tx < z[0] - tz) return Face::apex;
  return Face::surface;
}

/// Returns J v with J = diag(1, -1, ..).
template <int Dim>
Vec<Dim> reflected(Vec<Dim> v) {
  v.template tail<Dim - 1>() *= -1.0;
  return v;
}

/// Newton's method for the conditions of a solution if the face of each block is known: A x = b and Q x + c - A' y = z.
/// If x lies inside the cone, z = 0. If x lies on the surface of the cone, x' J x = 0 and z = l J x. The multiplier l
/// is unknown.
template <int Dim>
struct KnownFaces {
  const ConeProgram<Dim>& program;
  std::vector<Vec<Dim>> x;
  Eigen::VectorXd y;
  std::vector<Face> face;
  std::vector<double> multiplier;  ///< multiplier l of each block on the surface
  std::vector<Mat<Dim>> flexibility;
  std::vector<Vec<Dim>> shift;  ///< change of x if y does not change
  double error = 0.0;           ///< largest error of the equations before the last step

  KnownFaces(const ConeProgram<Dim>& of, const ConeSolution<Dim>& start)
      : program(of), x(start.x), y(start.motion), flexibility(x.size()), shift(x.size()) {
    const std::vector<Vec<Dim>> z = gradient();
    for (std::size_t k = 0; k < x.size(); ++k) {
      face.push_back(face_of<Dim>(x[k], z[k]));
      if (face[k] == Face::apex) x[k].setZero();
      multiplier.push_back(face[k] == Face::surface ? std::max(0.0, z[k][0]) / x[k][0] : 0.0);
    }
  }

  /// Returns Q x + c - A' y, which equals z in a solution.
  std::vector<Vec<Dim>> gradient() const {
    std::vector<Vec<Dim>> out = program.relative_motion(y);
    for (std::size_t k = 0; k < x.size(); ++k)
      out[k] = program.compliance[k].cwiseProduct(x[k]) + program.linear[k] - out[k];
    return out;
  }

  /// Linearises the conditions of the blocks. If y changes by dy, x changes by `flexibility` A' dy + `shift`.
  void linearise() {
    const std::vector<Vec<Dim>> z = gradient();
    error = (program.balance(x) - program.load).template lpNorm<Eigen::Infinity>();
    for (std::size_t k = 0; k < x.size(); ++k) {
      flexibility[k].setZero();
      shift[k].setZero();
      // If a contact has no friction, the coefficients and compliances of its tangential forces are zero.
      const bool slippery = program.compliance[k].template tail<Dim - 1>().isZero(0.0);
      if (face[k] == Face::apex) continue;
      if (slippery) {
        x[k].template tail<Dim - 1>().setZero();
        flexibility[k](0, 0) = 1.0 / program.compliance[k][0];
        shift[k][0] = -flexibility[k](0, 0) * z[k][0];
        error = std::max(error, std::abs(z[k][0]));
      } else if (face[k] == Face::interior) {
        flexibility[k] = program.compliance[k].cwiseInverse().asDiagonal();
        shift[k] = -flexibility[k] * z[k];
        error = std::max(error, z[k].template lpNorm<Eigen::Infinity>());
      } else {
        linearise_surface(static_cast<int>(k), z[k]);
      }
    }
  }

  /// Changes y by dy, and changes x and the multipliers accordingly.
  void step(const Eigen::VectorXd& dy) {
    const std::vector<Vec<Dim>> motion = program.relative_motion(dy);
    y += dy;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += flexibility[k] * motion[k] + shift[k];
    // The multiplier l is fitted to z = l J x at the new x by least squares.
    const std::vector<Vec<Dim>> z = gradient();
    for (std::size_t k = 0; k < x.size(); ++k)
      if (face[k] == Face::surface) multiplier[k] = z[k].dot(reflected<Dim>(x[k])) / x[k].squaredNorm();
  }

  /// Returns the largest violation of the inequalities.
  double violation() const {
    const std::vector<Vec<Dim>> z = gradient();
    double most = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      most = std::max(most, face[k] == Face::apex ? -cone::margin<Dim>(z[k]) : -cone::margin<Dim>(x[k]));
      if (face[k] == Face::surface) most = std::max(most, -multiplier[k]);
    }
    return most;
  }

 private:
  /// Linearises the conditions of a block on the surface of the cone, Q x + c - A' y = l J x and x' J x = 0. The
  /// multiplier l is an additional unknown.
  void linearise_surface(int k, const Vec<Dim>& z) {
    const Vec<Dim> normal = reflected<Dim>(x[k]);
    const Vec<Dim> off = z - multiplier[k] * normal;
    const double outside = 0.5 * x[k].dot(normal);
    Eigen::Matrix<double, Dim + 1, Dim + 1> system = Eigen::Matrix<double, Dim + 1, Dim + 1>::Zero();
    system.diagonal().template head<Dim>() =
        program.compliance[k] - multiplier[k] * reflected<Dim>(Vec<Dim>::Ones());
    system.template topRightCorner<Dim, 1>() = normal;
    system.template bottomLeftCorner<1, Dim>() = normal.transpose();
    const Eigen::Matrix<double, Dim + 1, Dim + 1> inverse = system.inverse();
    flexibility[k] = inverse.template topLeftCorner<Dim, Dim>();
    shift[k] = -flexibility[k] * off - inverse.template topRightCorner<Dim, 1>() * outside;
    error = std::max({error, off.template lpNorm<Eigen::Infinity>(), std::abs(outside)});
  }
};

}  // namespace

template <int Dim>
void InteriorPoint<Dim>::polish(const ConeProgram<Dim>& program, ConeSolution<Dim>& solution) {
  KnownFaces<Dim> newton(program, solution);
  double best = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kMostNewtonSteps; ++n) {
    newton.linearise();
    if (!(newton.error < 0.5 * best)) break;
    best = newton.error;
    if (newton.error < kViolation && newton.violation() < kViolation) {
      solution.x = newton.x;
      solution.motion = newton.y;
    }
    if (!factorize(program, newton.flexibility)) break;
    ++solution.n_factorizations;
    const Eigen::VectorXd rest = program.load - program.balance(newton.x) - program.balance(newton.shift);
    newton.step(factor_.solve(rest, 3).col(0));
  }
  solution.residual = (program.balance(solution.x) - program.load).template lpNorm<Eigen::Infinity>();
}

template void InteriorPoint<2>::polish(const ConeProgram<2>&, ConeSolution<2>&);
template void InteriorPoint<3>::polish(const ConeProgram<3>&, ConeSolution<3>&);

}  // namespace floc
