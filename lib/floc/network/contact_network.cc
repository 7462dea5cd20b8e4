#include "floc/network/contact_network.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "floc/packing/wall_forces.h"

namespace floc {

Mat<2> contact_frame(const Vec<2>& n) {
  Mat<2> frame;
  frame << n, tangent<double>(n);
  return frame;
}

Mat<3> contact_frame(const Vec<3>& n) {
  Mat<3> frame;
  frame.col(0) = n;
  frame.col(1) = n.unitOrthogonal();
  frame.col(2) = n.cross(frame.col(1));
  return frame;
}

namespace {

/// Returns the axes with walls whose two walls may move together. If forces move some wall of the box, both walls of
/// such an axis follow forces, since the place of a wall that forces do not move is given. If forces move no wall, as
/// in imported packings, nothing is known about the walls, and those of each axis may move together.
template <int Dim>
std::vector<int> shifting_axes(const Packing<Dim>& packing) {
  const bool any_moves = std::ranges::any_of(packing.walls, follows_forces<Dim>);
  std::vector<int> axes;
  for (int a = 0; a < Dim; ++a)
    if (between_walls(packing.walls, a) && (!any_moves || n_moving_walls(packing, a) == 2)) axes.push_back(a);
  return axes;
}

/// Returns the branch vector of a contact with a wall, as defined for NetworkContact::branch.
/// @param origin  strain_origin() of the packing
template <int Dim>
Vec<Dim> strained_branch(const Packing<Dim>& packing, const Contact<Dim>& c, const Vec<Dim>& origin) {
  Vec<Dim> branch = stress_lever(packing, c);
  const Wall<Dim>& wall = packing.wall(c.j);
  for (int b = 0; b < Dim; ++b)
    if (b != wall.axis && between_walls(packing.walls, b))
      branch[b] = origin[b] - packing.grains.position[c.i][b];
  return branch;
}

template <int Dim>
NetworkContact<Dim> network_contact(const Packing<Dim>& packing, const Contact<Dim>& c, int source,
                                    const Vec<Dim>& origin) {
  const Vec<Dim> r = branch(packing, c);
  const bool on_wall = packing.is_wall(c.j);
  NetworkContact<Dim> out;
  out.i = c.i;
  out.j = on_wall ? c.i : c.j;
  if (on_wall) out.wall = c.j - packing.grains.size();
  out.image = c.image;
  out.branch = on_wall ? strained_branch<Dim>(packing, c, origin) : r;
  out.arm_i = c.arm_i;
  out.arm_j = c.arm_j;
  out.frame = contact_frame(packing.grains.are_round() ? Vec<Dim>(r.normalized()) : c.normal);
  out.kn = c.kn;
  out.kt = c.kt;
  out.kr = c.kr;
  out.ktw = c.ktw;
  out.normal_force = c.normal_force;
  out.shear_force = c.shear_force;
  out.rolling_moment = c.rolling_moment;
  out.twisting_moment = c.twisting_moment;
  out.distant = c.distant;
  out.source = source;
  return out;
}

}  // namespace

template <int Dim>
ContactNetwork<Dim> contact_network(const Packing<Dim>& packing) {
  ContactNetwork<Dim> network;
  network.wall_axes = shifting_axes(packing);
  network.n_grains = packing.grains.size();
  network.volume = packing.cell.volume();
  network.grain_size = packing.grains.radius;
  network.contacts.reserve(packing.contacts.size());
  const Vec<Dim> origin = strain_origin(packing);
  for (int c = 0; c < static_cast<int>(packing.contacts.size()); ++c)
    network.contacts.push_back(network_contact(packing, packing.contacts[c], c, origin));
  return network;
}

template <int Dim>
ContactNetwork<Dim> without_grains(const ContactNetwork<Dim>& network, const std::vector<bool>& removed) {
  assert(static_cast<int>(removed.size()) == network.n_grains);
  ContactNetwork<Dim> kept = network;
  std::erase_if(kept.contacts, [&](const NetworkContact<Dim>& c) { return removed[c.i] || removed[c.j]; });
  return kept;
}

template <int Dim>
double stiffness_scale(const ContactNetwork<Dim>& network) {
  double largest = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts) largest = std::max({largest, std::abs(c.kn), c.kt});
  return largest > 0.0 ? largest : 1.0;
}

template <int Dim>
void set_rolling_stiffness(ContactNetwork<Dim>& network, double kr) {
  assert(kr >= 0.0);
  for (NetworkContact<Dim>& c : network.contacts)
    if (!c.distant) c.kr = kr;
}

template ContactNetwork<2> contact_network(const Packing<2>&);
template ContactNetwork<3> contact_network(const Packing<3>&);
template ContactNetwork<2> without_grains(const ContactNetwork<2>&, const std::vector<bool>&);
template ContactNetwork<3> without_grains(const ContactNetwork<3>&, const std::vector<bool>&);
template double stiffness_scale(const ContactNetwork<2>&);
template double stiffness_scale(const ContactNetwork<3>&);
template void set_rolling_stiffness(ContactNetwork<2>&, double);
template void set_rolling_stiffness(ContactNetwork<3>&, double);

}  // namespace floc
