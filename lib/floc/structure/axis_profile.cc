#include "floc/structure/axis_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/geometry/ball_in_box.h"

namespace floc {
namespace {

/// Returns the volume of the part of a ball between two planes normal to the first axis.
/// @param place, low, high  coordinates on this axis: centre of the ball, first plane and second plane (length)
template <int Dim>
double ball_between(double place, double radius, double low, double high) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec<Dim> centre = Vec<Dim>::Zero(), from = Vec<Dim>::Constant(-kFar), to = Vec<Dim>::Constant(kFar);
  centre[0] = place, from[0] = low, to[0] = high;
  return ball_in_box<Dim>(centre, radius, from, to);
}

/// Adds the stress of each contact to the slices that its branch vector crosses. The share of a slice is the fraction
/// of the branch vector that lies in the slice.
/// @param to_reduced  vector whose scalar product with a position is the reduced coordinate along the axis (0 to 1 in
/// the cell)
/// @param origin  reduced coordinate at which the first slice begins
template <int Dim>
void add_stress(const Packing<Dim>& packing, const Vec<Dim>& to_reduced, double origin, bool walled,
                std::vector<ProfileSlice>& slices) {
  const int n = static_cast<int>(slices.size());
  const double slice_volume = packing.cell.volume() / n;
  for (const Contact<Dim>& c : packing.contacts) {
    const Vec<Dim> r = branch(packing, c);
    const Vec<Dim> along = (c.normal_force * c.normal - c.shear_force).cwiseProduct(r) / slice_volume;
    const double begin = (to_reduced.dot(packing.grains.position[c.i]) - origin) * n;
    const double end = begin + to_reduced.dot(r) * n;
    const double low = std::min(begin, end), high = std::max(begin, end);
    const int first = static_cast<int>(std::floor(low)), last = static_cast<int>(std::floor(high));
    for (int k = first; k <= last; ++k) {
      const double inside = std::min(high, k + 1.0) - std::max(low, static_cast<double>(k));
      const double share = first == last ? 1.0 : inside / (high - low);
      // If a branch vector ends on a wall, rounding may move its end beyond the wall, where there is no slice.
      const int slice = walled ? std::clamp(k, 0, n - 1) : ((k % n) + n) % n;
      for (int a = 0; a < Dim; ++a) slices[slice].stress[a] += share * along[a];
    }
  }
}

}  // namespace

template <int Dim>
std::vector<ProfileSlice> axis_profile(const Packing<Dim>& packing, int axis, int n,
                                       const std::vector<std::vector<double>>& values) {
  assert(0 <= axis && axis < Dim);
  require_in_range("slices", n, kProfileSlices);
  const Vec<Dim> to_reduced = packing.cell.matrix.transpose().inverse().row(axis).transpose();
  const double height = 1.0 / to_reduced.norm();
  const bool walled = between_walls(packing.walls, axis);
  double origin = 0.0;
  for (const Wall<Dim>& wall : packing.walls)
    if (wall.axis == axis && wall.side < 0) origin = wall.position / height;
  std::vector<ProfileSlice> slices(n);
  for (int k = 0; k < n; ++k) {
    slices[k].low = height * k / n, slices[k].high = height * (k + 1) / n;
    slices[k].mean.assign(values.size(), 0.0);
    slices[k].stress.assign(Dim, 0.0);
  }
  const double thickness = height / n, slice_volume = packing.cell.volume() / n;
  for (int i = 0; i < packing.grains.size(); ++i) {
    double s = to_reduced.dot(packing.grains.position[i]) - origin;
    if (!walled) s -= std::floor(s);
    const double radius = packing.grains.radius[i];
    if (s >= 0.0 && s <= 1.0) {  // a grain with its centre outside the walls belongs to no slice
      const int own = std::min(static_cast<int>(s * n), n - 1);
      ++slices[own].n_grains;
      for (std::size_t v = 0; v < values.size(); ++v) slices[own].mean[v] += values[v][i];
    }
    const int first = static_cast<int>(std::floor((s * height - radius) / thickness));
    const int last = static_cast<int>(std::floor((s * height + radius) / thickness));
    for (int k = first; k <= last; ++k) {
      if (walled && (k < 0 || k >= n)) continue;
      slices[((k % n) + n) % n].solid_fraction +=
          ball_between<Dim>(s * height, radius, k * thickness, (k + 1) * thickness) / slice_volume;
    }
  }
  add_stress(packing, to_reduced, origin, walled, slices);
  for (ProfileSlice& slice : slices)
    for (double& mean : slice.mean)
      mean = slice.n_grains > 0 ? mean / slice.n_grains : std::numeric_limits<double>::quiet_NaN();
  return slices;
}

template std::vector<ProfileSlice> axis_profile(const Packing<2>&, int, int,
                                                const std::vector<std::vector<double>>&);
template std::vector<ProfileSlice> axis_profile(const Packing<3>&, int, int,
                                                const std::vector<std::vector<double>>&);

}  // namespace floc
