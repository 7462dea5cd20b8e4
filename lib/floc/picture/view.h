#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Direction from which a packing in 3D is seen. The projection is parallel, and the z axis is upright. The defaults
/// show three faces of a cubic cell.
struct View {
  /// Azimuth of the eye (degrees): 0 if the eye is on the x axis, 90 if it is on the y axis.
  double azimuth = -65.0;
  /// Elevation of the eye above the x-y plane (degrees), -90 to 90.
  double elevation = 20.0;
  /// Drawn radius of a sphere divided by its true radius, 0 to 1. If absent, this ratio is 0.25 if the picture has
  /// lines for contacts, and 1 otherwise.
  std::optional<double> sphere_size;

  /// Returns all errors of the viewpoint, as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Rotates vectors from the coordinates of the packing to the coordinates of the viewer.
class Camera {
 public:
  explicit Camera(const View& view);

  /// Returns a point or a vector in the coordinates of the viewer: x to the right, y upwards, z towards the eye.
  Vec<3> seen(const Vec<3>& x) const { return rotation_ * x; }

 private:
  Mat<3> rotation_;
};

}  // namespace floc
