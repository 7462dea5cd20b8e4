#include "floc/structure/long_axes.h"

#include <Eigen/Eigenvalues>
#include <vector>

#include "floc/shape/moments.h"

namespace floc {
namespace {

/// A shape is elongated if the root of its largest second moment, divided by the root of the next one, is above this
/// value.
constexpr double kElongated = 1.05;

/// Returns the second moments of a shape with its rounding.
Mat<2> second_moments(const Shape<2>& shape) {
  return body_moments(core_of(shape), shape.rounding).second;
}

Mat<3> second_moments(const Shape<3>& shape) {
  // Of a body whose axes are principal axes, the moment of inertia about an axis is the sum of the second moments along
  // the two others.
  return (Vec<3>::Constant(0.5 * shape.inertia.sum()) - shape.inertia).asDiagonal();
}

/// Returns the direction of the long axis of a shape, in the coordinates of the shape; no value if the shape is not
/// elongated.
template <int Dim>
std::optional<Vec<Dim>> long_axis(const Shape<Dim>& shape) {
  if (shape.is_round()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Mat<Dim>> axes(second_moments(shape));
  const auto& values = axes.eigenvalues();
  if (!(values[Dim - 1] > kElongated * kElongated * values[Dim - 2])) return std::nullopt;
  return Vec<Dim>(axes.eigenvectors().col(Dim - 1));
}

}  // namespace

template <int Dim>
std::optional<AxesOrder<Dim>> long_axes_order(const Packing<Dim>& packing) {
  const Grains<Dim>& grains = packing.grains;
  if (grains.are_round()) return std::nullopt;
  std::vector<std::optional<Vec<Dim>>> axis;
  for (const Shape<Dim>& shape : *grains.shapes) axis.push_back(long_axis(shape));
  AxesOrder<Dim> out;
  Mat<Dim> sum = Mat<Dim>::Zero();
  for (int i = 0; i < grains.size(); ++i) {
    const auto& own = axis[static_cast<std::size_t>(grains.shape[i])];
    if (!own) continue;
    const Vec<Dim> e = rotation_matrix(grains.orientation[i]) * *own;
    sum += (Dim * e * e.transpose() - Mat<Dim>::Identity()) / (Dim - 1);
    ++out.n_grains;
  }
  if (out.n_grains == 0) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Mat<Dim>> directions(sum / out.n_grains);
  out.order = directions.eigenvalues()[Dim - 1];
  out.direction = directions.eigenvectors().col(Dim - 1);
  return out;
}

template std::optional<AxesOrder<2>> long_axes_order(const Packing<2>&);
template std::optional<AxesOrder<3>> long_axes_order(const Packing<3>&);

}  // namespace floc
