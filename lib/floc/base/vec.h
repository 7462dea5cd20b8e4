#pragma once

#include <Eigen/Core>

namespace floc {

/// A vector of Dim components of number type T.
template <int Dim, class T = double>
using Vec = Eigen::Matrix<T, Dim, 1>;

/// A Dim x Dim matrix.
template <int Dim, class T = double>
using Mat = Eigen::Matrix<T, Dim, Dim>;

/// Number of independent rotations of a grain: 1 in 2D (about the normal of the plane), 3 in 3D.
template <int Dim>
inline constexpr int kRotations = Dim*(Dim - 1) / 2;

/// Number of degrees of freedom of one grain. They are ordered as translations, then rotations.
template <int Dim>
inline constexpr int kDofs = Dim + kRotations<Dim>;

/// Vector of the components of an angular velocity, of a moment or of a small rotation.
template <int Dim, class T = double>
using RotationVector = Eigen::Matrix<T, kRotations<Dim>, 1>;

/// Number of independent components of a symmetric tensor, such as strain or stress: 3 in 2D, 6 in 3D.
template <int Dim>
inline constexpr int kSymmetric = Dim*(Dim + 1) / 2;

}  // namespace floc
