#include "floc/network/free_motions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// Two ways around a component differ by a lattice vector or by rounding; the smallest lattice vector is of the
/// order of a grain.
constexpr double kWraps = 1e-3;
/// A rigid motion is distinct from those already pinned if it moves something by more than this share of its
/// arm.
constexpr double kDistinct = 1e-6;

using Adjacency = std::vector<std::vector<int>>;

template <int Dim>
Adjacency contacts_of_grains(const ContactNetwork<Dim>& network) {
  Adjacency of(network.n_grains);
  for (int c = 0; c < static_cast<int>(network.contacts.size()); ++c) {
    of[network.contacts[c].i].push_back(c);
    of[network.contacts[c].j].push_back(c);
  }
  return of;
}

template <int Dim>
void keep_grain(FreeMotions& free, int grain, bool keep) {
  std::fill_n(free.kept.begin() + first_unknown<Dim>(grain), kDofs<Dim>, keep);
}

/// Takes off the tips of dead ends; `active` contacts are those of the core that remains.
template <int Dim>
void remove_dead_ends(const ContactNetwork<Dim>& network, const Adjacency& of, std::vector<bool>& active,
                      FreeMotions& free) {
  std::vector<int> degree(network.n_grains);
  std::vector<int> tips;
  for (int i = 0; i < network.n_grains; ++i) {
    degree[i] = static_cast<int>(of[i].size());
    if (degree[i] == 0) ++free.n_alone, keep_grain<Dim>(free, i, false);
    if (degree[i] == 1) tips.push_back(i);
  }
  while (!tips.empty()) {
    const int tip = tips.back();
    tips.pop_back();
    if (degree[tip] != 1) continue;  // the last of a tree: its contact went with its neighbour
    const int c = *std::find_if(of[tip].begin(), of[tip].end(), [&](int k) { return active[k]; });
    const NetworkContact<Dim>& contact = network.contacts[c];
    active[c] = false;
    free.dead_end[tip] = true;
    keep_grain<Dim>(free, tip, false);
    if (contact.kt == 0.0 || contact.kr == 0.0) ++free.n_free_rollers;
    if (contact.kn < 0.0) ++free.n_unstable_ends;
    const int neighbour = contact.i == tip ? contact.j : contact.i;
    degree[tip] = 0;
    if (--degree[neighbour] == 1) tips.push_back(neighbour);
    if (degree[neighbour] == 0) ++free.n_alone, keep_grain<Dim>(free, neighbour, false);
  }
}

/// Grains joined to `start` by rolling stiffness, itself included; says whether a tangential spring holds any of them.
template <int Dim>
bool walk_rolling_group(const ContactNetwork<Dim>& network, const Adjacency& of,
                        const std::vector<bool>& active, int start, std::vector<bool>& seen) {
  bool held = false;
  std::vector<int> queue{start};
  seen[start] = true;
  while (!queue.empty()) {
    const int grain = queue.back();
    queue.pop_back();
    for (const int k : of[grain]) {
      if (!active[k]) continue;
      const NetworkContact<Dim>& c = network.contacts[k];
      if (c.kt != 0.0) held = true;
      const int other = c.i == grain ? c.j : c.i;
      if (c.kr == 0.0 || seen[other]) continue;
      seen[other] = true;
      queue.push_back(other);
    }
  }
  return held;
}

/// Without tangential springs a grain spins freely, and grains joined by rolling stiffness do so together.
template <int Dim>
void pin_free_spins(const ContactNetwork<Dim>& network, const Adjacency& of, const std::vector<bool>& active,
                    FreeMotions& free) {
  std::vector<bool> seen(network.n_grains, false);
  for (int i = 0; i < network.n_grains; ++i) {
    const int first = first_unknown<Dim>(i);
    if (seen[i] || !free.kept[first]) continue;
    if (walk_rolling_group(network, of, active, i, seen)) continue;
    ++free.n_free_spins;
    std::fill_n(free.kept.begin() + first + Dim, kRotations<Dim>, false);
  }
}

/// A connected component, unwrapped from the cell.
template <int Dim>
struct Component {
  std::vector<int> grains;
  std::vector<Vec<Dim>> place;  ///< of each grain, the first at the origin
  std::vector<Vec<Dim>> wraps;  ///< orthogonal directions in which it meets its own image
};

template <int Dim>
void note_wrap(Component<Dim>& component, Vec<Dim> mismatch, double grain_size) {
  const double length = mismatch.norm();
  if (length < kWraps * grain_size) return;
  for (const Vec<Dim>& w : component.wraps) mismatch -= w * w.dot(mismatch);
  if (mismatch.norm() > kWraps * length) component.wraps.push_back(mismatch.normalized());
}

template <int Dim>
Component<Dim> walk_component(const ContactNetwork<Dim>& network, const Adjacency& of,
                              const std::vector<bool>& active, int start, std::vector<int>& index) {
  Component<Dim> part{{start}, {Vec<Dim>::Zero()}, {}};
  index[start] = 0;
  for (std::size_t at = 0; at < part.grains.size(); ++at) {
    const int grain = part.grains[at];
    for (const int k : of[grain]) {
      if (!active[k]) continue;
      const NetworkContact<Dim>& c = network.contacts[k];
      const bool forward = c.i == grain;
      const int other = forward ? c.j : c.i;
      const Vec<Dim> place =
          forward ? Vec<Dim>(part.place[at] + c.branch) : Vec<Dim>(part.place[at] - c.branch);
      if (index[other] < 0) {
        index[other] = static_cast<int>(part.grains.size());
        part.grains.push_back(other);
        part.place.push_back(place);
      } else {
        note_wrap<Dim>(part, place - part.place[index[other]], network.grain_size[grain]);
      }
    }
  }
  return part;
}

/// Axes about which a component can turn without straining its images.
std::vector<Spin<2>> free_axes(const Component<2>& part) {
  if (!part.wraps.empty()) return {};
  return {Spin<2>(1.0)};
}
std::vector<Spin<3>> free_axes(const Component<3>& part) {
  if (part.wraps.size() > 1) return {};
  if (part.wraps.size() == 1) return {part.wraps[0]};
  return {Vec<3>::UnitX(), Vec<3>::UnitY(), Vec<3>::UnitZ()};
}

/// Rigid motions of a component: rows its unknowns (rotations times the grain's size), columns translations
/// then turns.
template <int Dim>
Eigen::MatrixXd rigid_motions(const ContactNetwork<Dim>& network, const Component<Dim>& part,
                              const FreeMotions& free) {
  const std::vector<Spin<Dim>> axes = free_axes(part);
  const int n = static_cast<int>(part.grains.size());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(kDofs<Dim> * n, Dim + static_cast<int>(axes.size()));
  for (int k = 0; k < n; ++k) {
    motions.block(kDofs<Dim> * k, 0, Dim, Dim).setIdentity();
    for (int a = 0; a < static_cast<int>(axes.size()); ++a) {
      motions.col(Dim + a).segment<Dim>(kDofs<Dim> * k) = cross<double>(axes[a], part.place[k]);
      motions.col(Dim + a).segment<kRotations<Dim>>(kDofs<Dim> * k + Dim) =
          axes[a] * network.grain_size[part.grains[k]];
    }
    for (int u = 0; u < kDofs<Dim>; ++u)
      if (!free.kept[first_unknown<Dim>(part.grains[k]) + u]) motions.row(kDofs<Dim> * k + u).setZero();
  }
  return motions;
}

/// Pins the unknown that each rigid motion moves most, once the motions before it are pinned.
template <int Dim>
void pin_component(const ContactNetwork<Dim>& network, const Component<Dim>& part, FreeMotions& free) {
  Eigen::MatrixXd motions = rigid_motions(network, part, free);
  const Eigen::RowVectorXd extent = motions.cwiseAbs().colwise().maxCoeff();
  for (int m = 0; m < motions.cols(); ++m) {
    Eigen::Index row = 0;
    const double most = motions.col(m).cwiseAbs().maxCoeff(&row);
    if (!(most > kDistinct * extent[m])) continue;  // turning a straight part about its own axis moves nothing
    const int grain = part.grains[row / kDofs<Dim>];
    free.kept[first_unknown<Dim>(grain) + row % kDofs<Dim>] = false;
    if (m >= Dim) ++free.n_free_rotations;
    const Eigen::RowVectorXd pivot = motions.row(row) / motions(row, m);
    const Eigen::VectorXd column = motions.col(m);
    motions.noalias() -= column * pivot;
    motions.row(row).setZero();
  }
}

}  // namespace

template <int Dim>
FreeMotions find_free_motions(const ContactNetwork<Dim>& network) {
  FreeMotions free;
  free.kept.assign(network.n_unknowns(), true);
  free.dead_end.assign(network.n_grains, false);
  std::vector<bool> active(network.contacts.size(), true);
  const Adjacency of = contacts_of_grains(network);
  remove_dead_ends(network, of, active, free);
  pin_free_spins(network, of, active, free);
  std::vector<int> index(network.n_grains, -1);
  for (int i = 0; i < network.n_grains; ++i) {
    if (index[i] >= 0 || !free.kept[first_unknown<Dim>(i)]) continue;
    pin_component(network, walk_component(network, of, active, i, index), free);
    ++free.n_components;
  }
  return free;
}

template FreeMotions find_free_motions(const ContactNetwork<2>&);
template FreeMotions find_free_motions(const ContactNetwork<3>&);

}  // namespace floc
