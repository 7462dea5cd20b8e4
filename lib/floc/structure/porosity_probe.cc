#include "floc/structure/porosity_probe.h"

#include <algorithm>
#include <cmath>

#include "floc/base/interruption.h"
#include "floc/geometry/ball_in_box.h"

namespace floc {
namespace {

/// Returns the centre of the cell or, along an axis with walls, the middle between the walls.
template <int Dim>
Vec<Dim> centre_of(const Packing<Dim>& packing) {
  Vec<Dim> centre = packing.cell.matrix.transpose() * Vec<Dim>::Constant(0.5);
  for (std::size_t w = 0; w + 1 < packing.walls.size(); w += 2)
    centre[packing.walls[w].axis] = 0.5 * (packing.walls[w].position + packing.walls[w + 1].position);
  return centre;
}

/// Calls visit(place, radius) for every periodic image of a grain that may reach into a box about the centre of the
/// cell.
/// @param half_width  half of the length of each side of the box
/// @param visit       function of two arguments: the vector from the centre of the cell to the centre of the image, and
/// the radius of the grain
template <int Dim, class Visit>
void for_images(const Packing<Dim>& packing, const Vec<Dim>& half_width, const Visit& visit) {
  const Mat<Dim> to_reduced = packing.cell.matrix.transpose().inverse();
  const Vec<Dim> centre = centre_of(packing);
  for (int i = 0; i < packing.grains.size(); ++i) {
    const double radius = packing.grains.radius[i];
    Vec<Dim> x = packing.grains.position[i] - centre;
    Vec<Dim, int> most = Vec<Dim, int>::Zero(), image;
    const Vec<Dim> s = to_reduced * x;
    for (int a = 0; a < Dim; ++a) {
      if (between_walls(packing.walls, a)) continue;
      x -= std::round(s[a]) * packing.cell.matrix.row(a).transpose();
      const double reach = to_reduced.row(a).cwiseAbs().dot(half_width) + radius * to_reduced.row(a).norm();
      most[a] = static_cast<int>(std::ceil(reach + 0.5));
    }
    image = -most;
    for (int a = 0; a < Dim;) {
      visit(Vec<Dim>(x + packing.cell.shift(image)), radius);
      for (a = 0; a < Dim && ++image[a] > most[a]; ++a) image[a] = -most[a];
    }
  }
}

template <int Dim>
double solid_fraction_in(const Packing<Dim>& packing, const Vec<Dim>& half_width) {
  double solid = 0.0;
  for_images(packing, half_width, [&](const Vec<Dim>& x, double radius) {
    solid += ball_in_box<Dim>(x, radius, Vec<Dim>(-half_width), half_width);
  });
  return solid / (2.0 * half_width).prod();
}

}  // namespace

template <int Dim>
std::vector<PorosityProbe> porosity_probes(const Packing<Dim>& packing, int n) {
  require_in_range("probes", n, kPorosityProbes);
  const Mat<Dim> to_reduced = packing.cell.matrix.transpose().inverse();
  double L = 1.0 / to_reduced.row(0).norm();
  for (int a = 1; a < Dim; ++a) L = std::min(L, 1.0 / to_reduced.row(a).norm());
  std::vector<PorosityProbe> probes;
  for (int k = 1; k <= n; ++k) {
    check_interruption();
    PorosityProbe probe;
    probe.half_side = 0.5 * k / n;
    probe.in_cube = solid_fraction_in(packing, Vec<Dim>(Vec<Dim>::Constant(probe.half_side * L)));
    if (packing.cell.rectangular())
      probe.in_cell =
          solid_fraction_in(packing, Vec<Dim>(probe.half_side * packing.cell.matrix.diagonal().cwiseAbs()));
    probes.push_back(probe);
  }
  return probes;
}

template std::vector<PorosityProbe> porosity_probes(const Packing<2>&, int);
template std::vector<PorosityProbe> porosity_probes(const Packing<3>&, int);

}  // namespace floc
