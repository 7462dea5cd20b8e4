#pragma once

#include <Eigen/Geometry>
#include <cstdint>
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

/// Round grains, one array entry per grain. Contacts refer to grains by their index in these arrays.
template <int Dim>
struct Grains {
  std::vector<Vec<Dim>> position;  ///< centre (length), inside the cell in a saved state
  /// Low part of the centre (length), added to `position`: less than half a unit in its last place; empty:
  /// zero.
  std::vector<Vec<Dim>> position_low;
  std::vector<Vec<Dim>> velocity;  ///< peculiar: without the affine part of the cell (length/time)
  std::vector<double> radius;      ///< (length)
  std::vector<double> mass;        ///< (mass)
  std::vector<Orientation<Dim>> orientation;
  std::vector<RotationVector<Dim>> angular_velocity;  ///< (1/time)
  /// Identifiers of the grains from another program, used in messages and tables; empty: the indices.
  std::vector<std::int64_t> id;

  int size() const { return static_cast<int>(radius.size()); }

  /// Makes n grains at the origin, at rest, of radius and mass zero.
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
  /// Identifier of grain i in messages and tables.
  std::int64_t name(int i) const { return id.empty() ? i : id[i]; }
  /// Keeps the identifiers only if they are not the indices.
  void set_names(std::vector<std::int64_t> names);
  /// Keeps the low parts only if at least one of them is not zero.
  void set_centres(const std::vector<DoubleDoubleVec<Dim>>& centres);

  Ball<Dim> shape(int i) const { return {radius[i]}; }
  double inertia(int i) const { return shape(i).inertia(mass[i]); }
};

/// Mechanical state of a packing: cell, walls, grains, laws and contacts.
template <int Dim>
struct Packing {
  /// Periodic cell. An axis between walls is not periodic: the side of the cell is normal to the walls and as
  /// long as their distance.
  Cell<Dim> cell;
  Grains<Dim> grains;
  Law law;                             ///< between grains
  std::vector<Contact<Dim>> contacts;  ///< sorted by (i, j, image, key), i <= j
  std::vector<Wall<Dim>> walls;        ///< none, or both of an axis, the lower one first, axes ascending
  Law wall_law;                        ///< between grains and walls

  /// Whether body j of a contact is a wall. The indices of walls follow those of the grains.
  bool is_wall(int body) const { return body >= grains.size(); }
  const Wall<Dim>& wall(int body) const { return walls[body - grains.size()]; }
  /// Radius of a body about its end of a branch (length): zero for a wall, since the branch ends on its
  /// surface.
  double surface_radius(int body) const { return is_wall(body) ? 0.0 : grains.radius[body]; }
};

/// Whether an axis lies between two walls.
template <int Dim>
bool between_walls(const std::vector<Wall<Dim>>& walls, int axis) {
  for (const Wall<Dim>& wall : walls)
    if (wall.axis == axis) return true;
  return false;
}

/// Cell for a search of neighbours whose centres are closer than `reach` (length). It is widened along axes
/// between walls, so that no grain is close to an image across them.
template <int Dim>
Cell<Dim> search_cell(Cell<Dim> cell, const std::vector<Wall<Dim>>& walls, double reach);

/// Solid fraction: area (2D) or volume (3D) of the grains over that of the cell. Overlaps count twice, as is
/// customary.
template <int Dim>
double solid_fraction(const Packing<Dim>& packing);

/// Branch of a contact (length): vector from the centre of i to the centre of the image of j, or to the nearest
/// point of a wall.
template <int Dim>
DoubleDoubleVec<Dim> exact_branch(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Branch of a contact (length), rounded: each component is right to the last digit.
template <int Dim>
Vec<Dim> branch(const Packing<Dim>& packing, const Contact<Dim>& contact);

}  // namespace floc
