#include "floc/io/listed_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floc/base/error.h"

namespace floc {
namespace {

template <int Dim>
std::vector<int> periodic_axes(const Packing<Dim>& packing) {
  std::vector<int> axes;
  for (int a = 0; a < Dim; ++a)
    if (!between_walls(packing.walls, a)) axes.push_back(a);
  return axes;
}

}  // namespace

template <int Dim>
Vec<Dim, int> whole_cells(const FileLine& place, const Vec<Dim>& cells) {
  if (!(cells.cwiseAbs().maxCoeff() < kFarthestImage))
    throw InputError(
        place.text(),
        "a grain lies more than 1e9 cells away from the cell: --cell is too small, or a coordinate is "
        "wrong");
  return cells.template cast<int>();
}

template <int Dim>
double smallest_width(const Packing<Dim>& packing) {
  // Each column of the inverse cell matrix is normal to a pair of opposite faces of the cell. The length of the column
  // is the inverse of the distance between these faces.
  const Mat<Dim> inverse = packing.cell.matrix.inverse();
  double steepest = 0.0;
  for (int a = 0; a < Dim; ++a)
    if (!between_walls(packing.walls, a)) steepest = std::max(steepest, inverse.col(a).norm());
  return steepest > 0.0 ? 1.0 / steepest : std::numeric_limits<double>::infinity();
}

// The function first finds the image with the smallest reduced coordinates relative to grain i. In a skewed cell, a
// neighbour of this image can be nearer, so the distances of all neighbouring images are compared.
template <int Dim>
Vec<Dim, int> nearest_image(const Packing<Dim>& packing, const FileLine& place, int i, int j) {
  const Vec<Dim> apart = packing.grains.position[j] - packing.grains.position[i];
  const std::vector<int> periodic = periodic_axes(packing);
  Vec<Dim> reduced = Vec<Dim>::Zero();
  for (const int a : periodic) reduced[a] = -std::round(packing.cell.reduced(apart)[a]);
  const Vec<Dim, int> guess = whole_cells<Dim>(place, reduced);
  Vec<Dim, int> best = guess;
  double nearest = std::numeric_limits<double>::infinity();
  int n_images = 1;
  for (std::size_t k = 0; k < periodic.size(); ++k) n_images *= 3;
  for (int m = 0; m < n_images; ++m) {
    Vec<Dim, int> image = guess;
    int rest = m;
    for (const int a : periodic) image[a] += rest % 3 - 1, rest /= 3;
    const double distance = (apart + packing.cell.shift(image)).norm();
    if ((i == j && image.isZero()) || distance >= nearest) continue;
    nearest = distance;
    best = image;
  }
  return best;
}

#define FLOC_INSTANTIATE(Dim)                                                \
  template Vec<Dim, int> whole_cells<Dim>(const FileLine&, const Vec<Dim>&); \
  template double smallest_width(const Packing<Dim>&);                       \
  template Vec<Dim, int> nearest_image(const Packing<Dim>&, const FileLine&, int, int);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
