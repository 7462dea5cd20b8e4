#include "floc/picture/pressure_picture.h"

#include <algorithm>
#include <cmath>

#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/picture/drawn_scale.h"
#include "floc/structure/particle_stress.h"

namespace floc {
namespace {

constexpr double kShown = 0.98;

/// Returns the quantile `share` (a fraction) of the magnitudes of the values.
double size_within(std::vector<double> values, double share) {
  for (double& value : values) value = std::abs(value);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

template <int Dim>
PackingPicture<Dim> grain_pressures(const Packing<Dim>& packing, double pressure) {
  PackingPicture<Dim> picture = grains_of(packing);
  picture.shade.value = particle_pressure(packing);
  picture.shade.name = "pressure of a grain divided by P,";
  double unit = pressure;
  if (unit <= 0.0) {
    picture.shade.name =
        Dim == 2 ? "pressure of a grain divided by F₀/a," : "pressure of a grain divided by F₀/a²,";
    unit = pull_off_force(packing) / std::pow(largest_diameter(picture.radius), Dim - 1);
  }
  if (unit > 0.0)
    for (double& value : picture.shade.value) value /= unit;
  const double size = size_within(picture.shade.value, kShown);
  if (size > 0.0) picture.shade.largest = size;
  return picture;
}

template PackingPicture<2> grain_pressures(const Packing<2>&, double);
template PackingPicture<3> grain_pressures(const Packing<3>&, double);

}  // namespace floc
