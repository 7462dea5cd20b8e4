#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "floc/base/vec.h"
#include "floc/contact/law.h"
#include "floc/geometry/cell.h"
#include "floc/geometry/separation.h"
#include "floc/packing/ball.h"
#include "floc/packing/contact.h"
#include "floc/packing/wall.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Orientation of a grain: an angle (radians) in 2D, a unit quaternion in 3D.
template <int Dim>
using Orientation = std::conditional_t<Dim == 2, double, Eigen::Quaterniond>;

template <int Dim>
inline Orientation<Dim> no_rotation() {
  if constexpr (Dim == 2) {
    return 0.0;
  } else {
    return Eigen::Quaterniond::Identity();
  }
}

/// Grains, with one array entry per grain. Contacts refer to grains by their index in these arrays.
template <int Dim>
struct Grains {
  std::vector<Vec<Dim>> position;  ///< position of the centre (length); in a saved state, inside the cell
  /// Low part of the position of the centre (length): position + position_low is the position in extended precision.
  /// The low part is less than half a unit in the last place of `position`. If the array is empty, all low parts are
  /// zero.
  std::vector<Vec<Dim>> position_low;
  std::vector<Vec<Dim>> velocity;  ///< peculiar velocity, without the affine motion of the cell (length/time)
  /// Radius of each grain (length); for a grain with corners, the radius of the smallest sphere (circle in 2D) about
  /// its centre of mass that contains the grain.
  std::vector<double> radius;
  std::vector<double> mass;  ///< mass of each grain (mass)
  std::vector<Orientation<Dim>> orientation;
  std::vector<RotationVector<Dim>> angular_velocity;  ///< angular velocity of each grain (radians/time)
  /// Identifiers of the grains in the file of another program. Messages and tables use these identifiers or, if the
  /// array is empty, the indices of the grains.
  std::vector<std::int64_t> id;
  /// Shapes of the grains; null if all grains are disks or spheres. Copies of a packing share one table of shapes.
  std::shared_ptr<const std::vector<Shape<Dim>>> shapes;
  std::vector<int> shape;  ///< for each grain, the index of its shape in `shapes`; empty without shapes
  std::vector<double>
      scale;  ///< for each grain, the factor by which its shape is magnified; empty without shapes

  int size() const { return static_cast<int>(radius.size()); }

  /// Makes n grains at the origin, at rest, with zero radius and zero mass.
  static Grains with_size(int n) {
    Grains g;
    g.position.assign(n, Vec<Dim>::Zero());
    g.velocity.assign(n, Vec<Dim>::Zero());
    g.radius.assign(n, 0.0);
    g.mass.assign(n, 0.0);
    g.orientation.assign(n, no_rotation<Dim>());
    g.angular_velocity.assign(n, RotationVector<Dim>::Zero());
    return g;
  }

  DoubleDoubleVec<Dim> centre(int i) const {
    return double_double<Dim>(position[i], position_low.empty() ? Vec<Dim>(Vec<Dim>::Zero()) : position_low[i]);
  }
  /// Returns the identifier of grain i in messages and tables.
  std::int64_t name(int i) const { return id.empty() ? i : id[i]; }
  /// Sets the identifiers of the grains. They are stored only if they differ from the indices.
  void set_names(std::vector<std::int64_t> names);
  /// Sets the positions of the centres. Low parts (position_low) are stored only if at least one of them is not zero.
  void set_centres(const std::vector<DoubleDoubleVec<Dim>>& centres);

  /// Whether all grains are disks or spheres.
  bool are_round() const { return shapes == nullptr; }
  /// Returns the shape of grain i at its position and orientation.
  /// @pre !are_round()
  PlacedShape<Dim> placed(int i) const;
  /// Returns the area (2D) or volume (3D) of grain i (length^Dim).
  double volume(int i) const;
  /// Returns the moment of inertia of a disk or sphere about its centre (mass * length^2).
  /// @pre are_round()
  double inertia(int i) const { return Ball<Dim>{radius[i]}.inertia(mass[i]); }
  /// Returns the inertia tensor of grain i about its centre of mass, in space-fixed axes (mass * length^2).
  Mat<kRotations<Dim>> inertia_tensor(int i) const;
};

/// Returns the rotation matrix of an orientation. It transforms vectors from the axes of the grain to the axes of
/// space.
inline Mat<2> rotation_matrix(double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}
inline Mat<3> rotation_matrix(const Eigen::Quaterniond& orientation) {
  return orientation.toRotationMatrix();
}

/// Mechanical state of a packing: cell, walls, grains, contact laws and contacts.
template <int Dim>
struct Packing {
  /// Periodic cell. An axis between walls is not periodic; the side of the cell along this axis is normal to the walls,
  /// and its length is the distance between the walls.
  Cell<Dim> cell;
  Grains<Dim> grains;
  Law law;                             ///< contact law between grains
  std::vector<Contact<Dim>> contacts;  ///< contacts, sorted by (i, j, image, key) with i <= j
  /// Walls or open ends of the axes that are not periodic, in ascending order of the axes: for each axis first the
  /// lower end, then the upper end. Empty if all axes are periodic.
  std::vector<Wall<Dim>> walls;
  Law wall_law;  ///< contact law between grains and walls
  /// Acceleration due to gravity, which acts on every grain as a body force (length/time^2); zero along periodic axes.
  Vec<Dim> gravity = Vec<Dim>::Zero();

  /// Returns whether the index j of a contact refers to a wall. The indices of walls follow the indices of the grains.
  bool is_wall(int body) const { return body >= grains.size(); }
  const Wall<Dim>& wall(int body) const { return walls[body - grains.size()]; }
  /// Returns the distance (length) from the end of a branch vector to the surface of the body at this end. It is the
  /// radius of a grain, and zero for a wall, because the branch vector ends on the surface of the wall.
  double surface_radius(int body) const { return is_wall(body) ? 0.0 : grains.radius[body]; }
  /// Returns the contact law of a contact: the law between grains or the law between grains and walls.
  const Law& law_of(const Contact<Dim>& contact) const { return is_wall(contact.j) ? wall_law : law; }
};

/// Returns whether an axis of the cell has two ends, each of which is a wall or open. All other axes are periodic.
template <int Dim>
bool between_walls(const std::vector<Wall<Dim>>& walls, int axis) {
  for (const Wall<Dim>& wall : walls)
    if (wall.axis == axis) return true;
  return false;
}

/// Returns whether at least one of the two ends of an axis is open.
template <int Dim>
bool is_open_along(const std::vector<Wall<Dim>>& walls, int axis) {
  for (const Wall<Dim>& wall : walls)
    if (wall.axis == axis && wall.open) return true;
  return false;
}

/// Returns whether at least one end of an axis is open.
template <int Dim>
bool is_open(const std::vector<Wall<Dim>>& walls) {
  for (const Wall<Dim>& wall : walls)
    if (wall.open) return true;
  return false;
}

/// Returns the cell for a search for neighbours whose centres are closer than `reach` (length). The cell is widened
/// along axes between walls, so that no grain is close to a periodic image along these axes.
template <int Dim>
Cell<Dim> search_cell(Cell<Dim> cell, const std::vector<Wall<Dim>>& walls, double reach);

/// Sets the velocities and angular velocities of all grains, and the velocity of the cell, to zero. Walls keep their
/// velocities.
template <int Dim>
void stop_grains(Packing<Dim>& packing);

/// Sets the velocities of all grains, the cell and all walls to zero.
template <int Dim>
void stop_all_bodies(Packing<Dim>& packing);

/// Returns the solid fraction: the area (2D) or volume (3D) of the grains divided by the area or volume of the
/// cell. Overlaps count twice, as is customary.
template <int Dim>
double solid_fraction(const Packing<Dim>& packing);

/// Returns the branch vector of a contact (length) in extended precision: from the centre of i to the centre of
/// the image of j, or to the nearest point of a wall.
template <int Dim>
DoubleDoubleVec<Dim> exact_branch(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the branch vector of a contact (length), rounded to double precision: each component is correct to the last
/// digit.
template <int Dim>
Vec<Dim> branch(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the lever of a contact force in the stress of a packing (length): the branch vector of two grains or, for a
/// grain and a wall, the vector from the centre of the grain to the contact point. The contact point of a disk or sphere is
/// the point of the wall that is nearest to the centre.
template <int Dim>
Vec<Dim> stress_lever(const Packing<Dim>& packing, const Contact<Dim>& contact);

}  // namespace floc
