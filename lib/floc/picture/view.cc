#include "floc/picture/view.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace floc {

std::vector<std::string> View::validate() const {
  std::vector<std::string> faults;
  const auto demand = [&faults](bool holds, const std::string& fault) {
    if (!holds) faults.push_back(fault);
  };
  demand(azimuth >= -360.0 && azimuth <= 360.0,
         fmt::format("azimuth of the view = {} degrees: must be between -360 and 360", azimuth));
  demand(elevation >= -90.0 && elevation <= 90.0,
         fmt::format("elevation of the view = {} degrees: must be between -90 and 90", elevation));
  if (sphere_size)
    demand(*sphere_size >= 0.0 && *sphere_size <= 1.0,
           fmt::format("sphere size = {} times the true size: must be between 0 and 1", *sphere_size));
  return faults;
}

Camera::Camera(const View& view) {
  const double a = view.azimuth * std::numbers::pi / 180.0, e = view.elevation * std::numbers::pi / 180.0;
  rotation_ << -std::sin(a), std::cos(a), 0.0,                              //
      -std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e),  //
      std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e);
}

}  // namespace floc
