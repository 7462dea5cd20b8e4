#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// The viewpoint of a picture of spheres: parallel projection, z upright. The defaults show three faces of a
/// cell, none of them edge-on.
struct View {
  /// Where the eye is (degrees): 0 on the x axis, 90 on the y axis.
  double azimuth = -65.0;
  /// Height of the eye above the x-y plane (degrees), -90 to 90.
  double elevation = 20.0;
  /// Drawn radius of a sphere over its own, 0 to 1. Absent: 1, but 0.25 where there are lines between centres.
  std::optional<double> sphere_size;

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Turns a packing in front of the eye.
class Camera {
 public:
  explicit Camera(const View& view);

  /// A point or a vector as seen: to the right, upwards, and towards the eye.
  Vec<3> seen(const Vec<3>& x) const { return rotation_ * x; }

 private:
  Mat<3> rotation_;
};

}  // namespace floc
