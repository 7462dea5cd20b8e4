#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// The viewpoint of a picture of spheres: parallel projection, z upright. The defaults show three faces of a
/// cell, none of them edge-on.
struct View {
  /// Azimuth of the eye (degrees): 0 on the x axis, 90 on the y axis.
  double azimuth = -65.0;
  /// Height of the eye above the x-y plane (degrees), -90 to 90.
  double elevation = 20.0;
  /// Drawn radius of a sphere over its own, 0 to 1. If absent, 1, or 0.25 where there are lines between
  /// centres.
  std::optional<double> sphere_size;

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Rotation of space into the coordinates of the viewer.
class Camera {
 public:
  explicit Camera(const View& view);

  /// Returns a point or a vector in the coordinates of the viewer: to the right, upwards, and towards the eye.
  Vec<3> seen(const Vec<3>& x) const { return rotation_ * x; }

 private:
  Mat<3> rotation_;
};

}  // namespace floc
