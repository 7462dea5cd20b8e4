#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "floc/contact/contact_law.h"
#include "floc/neighbors/pairs.h"

namespace floc {

/// Dashpot coefficient to use with the velocity half a step before its force acts. The lag lets a dashpot damp more than
/// its coefficient says, by the factor exp(c dt/(4 m_eff)) to second order in the step; without this correction a
/// restitution of 0.015 comes out as 0.006 at a tenth of sqrt(m/K_N).
inline double lagging_damping(double coefficient, double mass_i, double mass_j, double time_step) {
  const double effective_mass = mass_i * mass_j / (mass_i + mass_j);
  return coefficient * std::exp(-0.25 * coefficient * time_step / effective_mass);
}

/// The neighbour pairs as the force loop reads them, sorted by (i, j, image), i <= j, and the row of forces that each
/// pair writes. Pairs of one grain i are consecutive, so a block of grains owns a block of pairs.
template <class Law, int Dim>
struct HotPairs {
  using Component = std::vector<double>;

  std::vector<NeighborPair<Dim>> key;
  std::array<Component, Dim> image;  ///< as numbers, in lengths of the cell
  Component radii;                   ///< Ri + Rj
  Component reach_squared;           ///< (Ri + Rj + range)^2: no interaction beyond
  Component share_i;                 ///< Ri/(Ri + Rj): share of the branch that is grain i's lever arm
  Component damping;
  std::vector<ContactHistory<Law, Dim>> history;

  std::array<Component, Dim> row_force;  ///< on j
  std::array<Component, kRotations<Dim>> row_torque_i, row_torque_j;

  std::vector<int> first_of_i;    ///< pairs of grain i are first_of_i[i] .. first_of_i[i + 1] - 1
  std::vector<int> first_with_j;  ///< entries of grain j in with_j
  std::vector<int> with_j;        ///< pairs in which a grain is the second, ascending

  HotPairs() = default;
  HotPairs(std::vector<NeighborPair<Dim>> pairs, const std::vector<double>& radius,
           const std::vector<double>& mass, const Law& law, double time_step);

  int size() const { return static_cast<int>(key.size()); }
  /// Takes over the histories of an older list of the same grains.
  void inherit(const HotPairs& old);
};

template <int Dim>
inline bool before(const NeighborPair<Dim>& p, const NeighborPair<Dim>& q) {
  if (p.i != q.i) return p.i < q.i;
  if (p.j != q.j) return p.j < q.j;
  for (int a = 0; a < Dim; ++a)
    if (p.image[a] != q.image[a]) return p.image[a] < q.image[a];
  return false;
}

template <class Law, int Dim>
HotPairs<Law, Dim>::HotPairs(std::vector<NeighborPair<Dim>> pairs, const std::vector<double>& radius,
                             const std::vector<double>& mass, const Law& law, double time_step)
    : key(std::move(pairs)) {
  const std::size_t n = key.size();
  const std::size_t n_grains = radius.size();
  for (auto* component : {&radii, &reach_squared, &share_i, &damping}) component->resize(n);
  for (auto* vector : {&image, &row_force})
    for (auto& component : *vector) component.assign(n, 0.0);
  for (auto* vector : {&row_torque_i, &row_torque_j})
    for (auto& component : *vector) component.assign(n, 0.0);
  history.resize(n);
  first_of_i.assign(n_grains + 1, 0);
  first_with_j.assign(n_grains + 1, 0);
  for (std::size_t p = 0; p < n; ++p) {
    const auto [i, j, image_p] = key[p];
    for (int a = 0; a < Dim; ++a) image[a][p] = image_p[a];
    radii[p] = radius[i] + radius[j];
    const double reach = radii[p] + law.range();
    reach_squared[p] = reach * reach;
    share_i[p] = radius[i] / radii[p];
    damping[p] = lagging_damping(law.damping_coefficient(mass[i], mass[j]), mass[i], mass[j], time_step);
    ++first_of_i[i + 1];
    ++first_with_j[j + 1];
  }
  for (std::size_t k = 0; k < n_grains; ++k) {
    first_of_i[k + 1] += first_of_i[k];
    first_with_j[k + 1] += first_with_j[k];
  }
  with_j.resize(n);
  std::vector<int> next(first_with_j.begin(), first_with_j.end() - 1);
  for (std::size_t p = 0; p < n; ++p) with_j[next[key[p].j]++] = static_cast<int>(p);
}

template <class Law, int Dim>
void HotPairs<Law, Dim>::inherit(const HotPairs& old) {
  int q = 0;
  for (int p = 0; p < size(); ++p) {
    while (q < old.size() && before(old.key[q], key[p])) ++q;
    if (q < old.size() && old.key[q] == key[p]) history[p] = old.history[q];
  }
}

}  // namespace floc
