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

/// Round grains, one array entry per grain. Contacts refer to grains by their index here.
template <int Dim>
struct Grains {
  std::vector<Vec<Dim>> position;  ///< centre (length), inside the cell in a saved state
  /// Offset of the centre from `position`, less than half a unit in its last place (length); empty: none.
  std::vector<Vec<Dim>> position_low;
  std::vector<Vec<Dim>> velocity;  ///< peculiar: without the affine part of the cell (length/time)
  std::vector<double> radius;      ///< (length)
  std::vector<double> mass;        ///< (mass)
  std::vector<Orientation<Dim>> orientation;
  std::vector<RotationVector<Dim>> angular_velocity;  ///< (1/time)
  /// Identifiers that another program gave the grains, by which messages and tables name them; empty: the indices.
  std::vector<std::int64_t> id;

  int size() const { return static_cast<int>(radius.size()); }

  /// n grains at the origin, at rest, of radius and mass zero.
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
  /// How messages and tables name grain i.
  std::int64_t name(int i) const { return id.empty() ? i : id[i]; }
  /// Keeps the identifiers only if they are not the indices.
  void set_names(std::vector<std::int64_t> names);
  /// Keeps the low parts only if at least one of them is not zero.
  void set_centres(const std::vector<DoubleDoubleVec<Dim>>& centres);

  Ball<Dim> shape(int i) const { return {radius[i]}; }
  double inertia(int i) const { return shape(i).inertia(mass[i]); }
};

/// Cell, walls, grains, laws and contacts: everything mechanical about one state.
template <int Dim>
struct Packing {
  /// Along an axis between walls nothing is periodic: the side of the cell is their distance, normal to them.
  Cell<Dim> cell;
  Grains<Dim> grains;
  Law law;                             ///< between grains
  std::vector<Contact<Dim>> contacts;  ///< sorted by (i, j, image, key), i <= j
  std::vector<Wall<Dim>> walls;        ///< none, or both of an axis, the lower one first, axes ascending
  Law wall_law;                        ///< between grains and walls

  /// Whether body j of a contact is a wall: their numbers follow those of the grains.
  bool is_wall(int body) const { return body >= grains.size(); }
  const Wall<Dim>& wall(int body) const { return walls[body - grains.size()]; }
  /// Radius of a body's surface about its end of a branch: zero for a wall, on which the branch itself
  /// ends.
  double surface_radius(int body) const { return is_wall(body) ? 0.0 : grains.radius[body]; }
};

/// Whether an axis lies between two walls.
template <int Dim>
bool between_walls(const std::vector<Wall<Dim>>& walls, int axis) {
  for (const Wall<Dim>& wall : walls)
    if (wall.axis == axis) return true;
  return false;
}

/// The cell for a search of neighbours whose centres are closer than `reach`: widened between walls, so that no
/// grain meets an image across them.
template <int Dim>
Cell<Dim> search_cell(Cell<Dim> cell, const std::vector<Wall<Dim>>& walls, double reach);

/// Area (2D) or volume (3D) of the grains over that of the cell. Overlaps count twice, as is the custom.
template <int Dim>
double solid_fraction(const Packing<Dim>& packing);

/// Branch of a contact: vector from the centre of i to the image of j that it touches, or to its foot on a
/// wall.
template <int Dim>
DoubleDoubleVec<Dim> exact_branch(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// The same, rounded: right to the last digit of each component.
template <int Dim>
Vec<Dim> branch(const Packing<Dim>& packing, const Contact<Dim>& contact);

}  // namespace floc
