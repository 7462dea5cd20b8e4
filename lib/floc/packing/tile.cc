#include "floc/packing/tile.h"

#include <algorithm>
#include <cassert>

#include "floc/packing/swap_sides.h"

namespace floc {
namespace {

/// Returns n/d rounded towards minus infinity.
int floor_divide(int n, int d) {
  return n >= 0 ? n / d : -((d - 1 - n) / d);
}

template <int Dim>
Vec<Dim, int> place_of(int tile, const Vec<Dim, int>& copies) {
  Vec<Dim, int> place;
  for (int a = 0; a < Dim; ++a) {
    place[a] = tile % copies[a];
    tile /= copies[a];
  }
  return place;
}

/// Returns the copy of the contact c of the original packing in copy number `tile` of the packing. The second grain of
/// the returned contact may belong to another copy of the packing, or to a periodic image of a copy.
template <int Dim>
Contact<Dim> placed(Contact<Dim> c, int tile, int n_grains, const Vec<Dim, int>& copies,
                    const ContactHistory<Dim>& parity) {
  Vec<Dim, int> to = place_of<Dim>(tile, copies) + c.image;
  int other = 0;
  for (int a = Dim - 1; a >= 0; --a) {
    c.image[a] = floor_divide(to[a], copies[a]);
    other = other * copies[a] + to[a] - c.image[a] * copies[a];
  }
  c.i += tile * n_grains;
  c.j += other * n_grains;
  if (c.j < c.i) swap_sides(parity, c);
  return c;
}

template <class T>
void repeat(std::vector<T>& values, int times) {
  const std::vector<T> once = values;
  values.reserve(times * once.size());
  for (int t = 1; t < times; ++t) values.insert(values.end(), once.begin(), once.end());
}

}  // namespace

template <int Dim>
Packing<Dim> tiled(const Packing<Dim>& packing, const Vec<Dim, int>& copies) {
  assert(copies.minCoeff() >= 1);
  const int n_tiles = copies.prod();
  const int n = packing.grains.size();
  Packing<Dim> out = packing;
  const Vec<Dim> factor = copies.template cast<double>();
  out.cell.matrix = factor.asDiagonal() * packing.cell.matrix;
  out.cell.velocity = factor.asDiagonal() * packing.cell.velocity;
  repeat(out.grains.velocity, n_tiles);
  repeat(out.grains.radius, n_tiles);
  repeat(out.grains.mass, n_tiles);
  repeat(out.grains.orientation, n_tiles);
  repeat(out.grains.angular_velocity, n_tiles);
  repeat(out.grains.shape, n_tiles);
  repeat(out.grains.scale, n_tiles);
  if (n_tiles > 1) out.grains.id.clear();  // otherwise the copies of a grain would have the same identifier
  out.contacts.clear();
  out.contacts.reserve(n_tiles * packing.contacts.size());
  const ContactHistory<Dim> parity = swap_parity<Dim>(packing.law);
  std::vector<DoubleDoubleVec<Dim>> centres;
  centres.reserve(n_tiles * packing.grains.position.size());
  for (int t = 0; t < n_tiles; ++t) {
    for (int i = 0; i < n; ++i)
      centres.push_back(displaced<Dim>(packing.grains.centre(i), packing.cell, place_of<Dim>(t, copies)));
    for (const Contact<Dim>& c : packing.contacts) out.contacts.push_back(placed(c, t, n, copies, parity));
  }
  out.grains.set_centres(centres);
  std::sort(out.contacts.begin(), out.contacts.end(), precedes<Contact<Dim>>);
  return out;
}

template Packing<2> tiled(const Packing<2>&, const Vec<2, int>&);
template Packing<3> tiled(const Packing<3>&, const Vec<3, int>&);

}  // namespace floc
