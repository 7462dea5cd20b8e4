#include "floc/relaxation/pair_arrays.h"

#include <algorithm>
#include <variant>

#include "floc/contact/history_layout.h"
#include "floc/contact/law_table.h"
#include "floc/packing/ball.h"
#include "floc/packing/contact_order.h"

namespace floc {
template <int Dim>
PairArrays<Dim>::PairArrays(const std::vector<NeighborPair<Dim>>& pairs, Partner partner,
                            const GrainArrays<Dim>& grains, const ComposedLaw& composed, double time_step,
                            int blocks_of_group)
    : partner_(partner), blocks_of_group_(blocks_of_group) {
  const std::span<const double> radius = grains.of_grains(grains.radius), mass = grains.of_grains(grains.mass);
  if (partner == Partner::grain && all_equal(radius) && all_equal(mass)) own_numbers_ = 0;
  const bool with_walls = partner == Partner::wall;
  const int n_grains = static_cast<int>(radius.size());
  reserve(pairs.size() + pairs.size() / 8 + static_cast<std::size_t>(n_grains));
  first_of_i_.assign(n_grains, 0);
  end_of_i_.assign(n_grains, 0);
  std::visit(
      [&]<class Law>(const Law& law) {
        const auto add_numbers_of = [&](int i, int j) {
          const CollisionMass masses =
              with_walls ? CollisionMass::against_wall(mass[i]) : CollisionMass::between(mass[i], mass[j]);
          add_numbers(radius[i], with_walls ? 0.0 : radius[j],
                      Law::kDampingFollowsStiffness
                          ? law.damping_coefficient(masses)
                          : lagging_damping(law.damping_coefficient(masses), masses.effective, time_step));
        };
        for (int k = 0; own_numbers_ == 0 && k < kPairPadding; ++k) add_numbers_of(0, 0);
        std::size_t next = 0;
        for (int i = 0; i < n_grains; ++i) {
          if (i % kGrainBlock == 0) begin_block();
          if (const int filled = size() % kPairPadding;
              filled != 0 && i - i_[size() - filled] >= kWindow && !with_walls)
            fill_pack();
          first_of_i_[i] = size();
          for (; next < pairs.size() && pairs[next].i == i; ++next) {
            add(pairs[next]);
            if (own_numbers_ != 0) add_numbers_of(i, pairs[next].j);
          }
          end_of_i_[i] = size();
        }
        fill_pack();
        first_of_block_.push_back(size());
        if constexpr (Law::kHasDamping) viscous.assign(size(), 0.0);
        if constexpr (Law::kNeedsReducedRadius) reduced_radius_ = reduced(radius);
        if constexpr (Law::kNeedsReducedMass) reduced_mass_ = reduced(mass);
        if constexpr (Law::kHoldsLiquid) keep_radii(radius);
        for_each_history<Law, Dim>([&](auto, auto place) { history[place].assign(size(), 0.0); });
      },
      composed.any);
}

/// Reserves memory for the pairs. Otherwise the arrays would grow while they are filled, and would for a moment take
/// twice their final memory.
template <int Dim>
void PairArrays<Dim>::reserve(std::size_t n_pairs) {
  i_.reserve(n_pairs), j_.reserve(n_pairs);
  for (auto& component : image_) component.reserve(n_pairs);
  if (own_numbers_ == 0) return;
  for (Component* component : {&radii_, &share_i_, &damping_}) component->reserve(n_pairs);
}

template <int Dim>
void PairArrays<Dim>::add(const NeighborPair<Dim>& key) {
  i_.push_back(key.i);
  j_.push_back(key.j);
  for (int a = 0; a < Dim; ++a) image_[a].push_back(static_cast<float>(key.image[a]));
  if (key.key != 0 && key_.empty()) key_.assign(i_.size() - 1, 0);
  if (key.key != 0 || !key_.empty()) key_.push_back(key.key);
}

template <int Dim>
void PairArrays<Dim>::add_numbers(double radius_i, double radius_j, double damping) {
  radii_.push_back(radius_i + radius_j);
  share_i_.push_back(lever_share(radius_i, radius_j));
  damping_.push_back(damping);
}

/// Returns the reduced radius or mass p q/(p + q) of each pair, where p and q are the radii or masses of the two
/// bodies. For a wall q is infinite; for padding pairs p = q.
/// @param of_grain  radius or mass of each grain
template <int Dim>
typename PairArrays<Dim>::Component PairArrays<Dim>::reduced(std::span<const double> of_grain) const {
  if (own_numbers_ == 0) return Component(kPairPadding, floc::reduced(of_grain[0], of_grain[0]));
  Component values(size());
  for (int p = 0; p < size(); ++p)
    values[p] = partner_ == Partner::wall ? of_grain[i_[p]] : floc::reduced(of_grain[i_[p]], of_grain[j_[p]]);
  return values;
}

/// Stores the radii of the two grains of each pair, which liquid bridges need. For pairs with walls no radii are
/// stored, since contacts with walls are dry.
template <int Dim>
void PairArrays<Dim>::keep_radii(std::span<const double> radius) {
  for (Component* component : {&radius_i_, &radius_j_, &strength_, &decay_, &reach_})
    component->assign(size(), 0.0);
  if (partner_ == Partner::wall) return;
  for (int p = 0; p < size(); ++p) {
    if (padding(p)) continue;
    radius_i_[p] = radius[i_[p]];
    radius_j_[p] = radius[j_[p]];
  }
}

template <int Dim>
void PairArrays<Dim>::refresh_bridges(const ComposedLaw& composed) {
  if (partner_ == Partner::wall) return;
  std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (Law::kHoldsLiquid)
          for (int p = 0; p < size(); ++p) {
            const Bridge<> bridge =
                law.adhesion.bridge(radius_i_[p], radius_j_[p], std::abs(bridge_volume()[p]));
            strength_[p] = bridge.strength;
            decay_[p] = bridge.decay;
            reach_[p] = bridge.reach;
          }
      },
      composed.any);
}

template <int Dim>
typename PairArrays<Dim>::Component& PairArrays<Dim>::bridge_volume() {
  return history[HistoryLayout<Dim>::kAdhesion];
}

template <int Dim>
const typename PairArrays<Dim>::Component& PairArrays<Dim>::bridge_volume() const {
  return history[HistoryLayout<Dim>::kAdhesion];
}

/// Adds padding pairs, which do not interact, until the last pack of pairs is full.
template <int Dim>
void PairArrays<Dim>::fill_pack() {
  while (size() % kPairPadding != 0) {
    const int grain = i_.back();
    i_.push_back(grain);
    j_.push_back(partner_ == Partner::wall ? j_.back() : grain);
    for (int a = 0; a < Dim; ++a) image_[a].push_back(kPaddingImage);
    if (!key_.empty()) key_.push_back(0);
    if (own_numbers_ == 0) continue;
    for (Component* component : {&radii_, &share_i_, &damping_}) component->push_back(0.0);
  }
}

template <int Dim>
void PairArrays<Dim>::begin_block() {
  if (static_cast<int>(first_of_block_.size()) % blocks_of_group_ == 0) fill_pack();
  first_of_block_.push_back(size());
}

template <int Dim>
NeighborPair<Dim> PairArrays<Dim>::key(int p) const {
  NeighborPair<Dim> key{i(p), j(p), {}};
  for (int a = 0; a < Dim; ++a) key.image[a] = static_cast<int>(image_[a][p]);
  if (!key_.empty()) key.key = key_[p];
  return key;
}

template <int Dim>
std::vector<NeighborPair<Dim>> PairArrays<Dim>::further_contacts() const {
  std::vector<NeighborPair<Dim>> further;
  for (int p = 0; p < static_cast<int>(key_.size()); ++p)
    if (key_[p] != 0) further.push_back(key(p));
  return further;
}

template <int Dim>
int PairArrays<Dim>::find(const NeighborPair<Dim>& wanted) const {
  for (int p = first_of_i_[wanted.i]; p < end_of_i_[wanted.i]; ++p)
    if (key(p) == wanted) return p;
  return -1;
}

template <int Dim>
void PairArrays<Dim>::inherit(const PairArrays& old) {
  for (std::size_t i = 0; i < old.first_of_i_.size(); ++i) {
    int q = old.first_of_i_[i];
    for (int p = first_of_i_[i]; p < end_of_i_[i]; ++p) {
      while (q < old.end_of_i_[i] && precedes(old.key(q), key(p))) ++q;
      if (q == old.end_of_i_[i]) break;
      if (!(old.key(q) == key(p))) continue;
      if (!viscous.empty()) viscous[p] = old.viscous[q];
      for (std::size_t k = 0; k < history.size(); ++k)
        if (!history[k].empty()) history[k][p] = old.history[k][q];
    }
  }
}

template <int Dim>
void PairArrays<Dim>::drop_numbers() {
  for (Component* component : {&share_i_, &damping_, &reduced_radius_, &reduced_mass_, &radius_i_, &radius_j_,
                               &strength_, &decay_, &reach_})
    *component = Component();
}

template <int Dim>
void PairArrays<Dim>::keep_history_alone() {
  drop_numbers();
  viscous = Component();
}

template <int Dim>
PairView<Dim> PairArrays<Dim>::view() {
  PairView<Dim> out;
  out.i = i_.data();
  out.j = j_.data();
  for (int a = 0; a < Dim; ++a) out.image[a] = image_[a].data();
  out.radii = radii_.data();
  out.share_i = share_i_.data();
  out.damping = damping_.data();
  out.reduced_radius = reduced_radius_.data();
  out.reduced_mass = reduced_mass_.data();
  out.strength = strength_.data();
  out.decay = decay_.data();
  out.reach = reach_.data();
  out.viscous = viscous.data();
  for (std::size_t k = 0; k < history.size(); ++k) out.history[k] = history[k].data();
  out.own_numbers = own_numbers_;
  out.row = nullptr;
  out.with_row = 0;
  return out;
}

template class PairArrays<2>;
template class PairArrays<3>;

}  // namespace floc
