#pragma once

#include <type_traits>
#include <utility>

#include "floc/base/vec.h"
#include "floc/contact/contact_history.h"
#include "floc/contact/history.h"
#include "floc/contact/law_parameters.h"
#include "floc/contact/model_traits.h"

/// Conversion between the two forms of the history of a contact. A ContactHistory has room for any model in each slot
/// of the contact law (HistoryLayout, history.h); a PackedHistory has only the numbers of the models of one law. A
/// check at compile time ensures that a ContactHistory is large enough for all models.
namespace floc {

namespace detail {

/// Number of values in the largest history among the models of one slot of a contact law (normal, adhesion, ...) that
/// are valid in a given dimension.
template <class Slot>
struct WidestHistory;
template <class... Models>
struct WidestHistory<LawSlot<Models...>> {
  static constexpr int in(int dim) {
    int widest = 0;
    const auto widen = [&](int model_dimension, int size) {
      if ((model_dimension == 0 || model_dimension == dim) && size > widest) widest = size;
    };
    (widen(kDimensionOf<Models>, history_size<Models>(dim)), ...);
    return widest;
  }
};

template <int Dim>
constexpr bool has_room_for_all_models() {
  using Layout = HistoryLayout<Dim>;
  return WidestHistory<decltype(LawParameters::normal)>::in(Dim) <= Layout::kNormalRoom &&
         WidestHistory<decltype(LawParameters::friction)>::in(Dim) <= Layout::kFrictionRoom &&
         WidestHistory<decltype(LawParameters::rolling)>::in(Dim) <= Layout::kRollingRoom &&
         WidestHistory<decltype(LawParameters::twisting)>::in(Dim) <= Layout::kTwistingRoom &&
         WidestHistory<decltype(LawParameters::adhesion)>::in(Dim) <= Layout::kAdhesionRoom;
}
static_assert(
    has_room_for_all_models<2>() && has_room_for_all_models<3>(),
    "the history of a model needs more numbers than HistoryLayout reserves for its slot: increase the "
    "constant of this slot in history.h");

}  // namespace detail

/// Returns the index in a ContactHistory of the value with index k in a PackedHistory, for the contact law `Law`.
template <class Law, int Dim>
constexpr int history_place(int k) {
  constexpr int n_normal = history_size<typename Law::NormalModel>(Dim);
  constexpr int n_friction = history_size<typename Law::TangentialModel>(Dim);
  constexpr int n_rolling = history_size<typename Law::RollingModel>(Dim);
  constexpr int n_twisting = history_size<typename Law::TwistingModel>(Dim);
  if (k < n_normal) return HistoryLayout<Dim>::kNormal + k;
  if (k < n_normal + n_friction) return HistoryLayout<Dim>::kFriction + k - n_normal;
  if (k < n_normal + n_friction + n_rolling) return HistoryLayout<Dim>::kRolling + k - n_normal - n_friction;
  if (k < n_normal + n_friction + n_rolling + n_twisting)
    return HistoryLayout<Dim>::kTwisting + k - n_normal - n_friction - n_rolling;
  return HistoryLayout<Dim>::kAdhesion + k - n_normal - n_friction - n_rolling - n_twisting;
}

/// Returns whether the value with index k in a PackedHistory is the first component of a vector in the tangent plane of
/// a 3D contact, for the contact law `Law`.
template <class Law, int Dim>
constexpr bool begins_tangent(int k) {
  int at = 0;
  bool begins = false;
  const auto look_at = [&]<class Model>(std::type_identity<Model>) {
    if constexpr (requires { Model::kHistory; })
      for (const History& m : Model::kHistory) {
        begins = begins || (at == k && is_tangential(m.kind));
        at += n_components(m.kind, Dim);
      }
  };
  look_at(std::type_identity<typename Law::NormalModel>{});
  look_at(std::type_identity<typename Law::TangentialModel>{});
  look_at(std::type_identity<typename Law::RollingModel>{});
  look_at(std::type_identity<typename Law::TwistingModel>{});
  look_at(std::type_identity<typename Law::AdhesionModel>{});
  return Dim == 3 && begins;
}

/// Calls visit(k, place) for each value in the history of a contact under `Law`, where k is its index in a
/// PackedHistory and `place` its index in a ContactHistory. The loop is unrolled; k and place are integral constants.
template <class Law, int Dim, class Visit>
[[gnu::always_inline]] inline void for_each_history(const Visit& visit) {
  [&]<int... k>(std::integer_sequence<int, k...>) __attribute__((always_inline)) {
    (visit(std::integral_constant<int, k>{}, std::integral_constant<int, history_place<Law, Dim>(k)>{}), ...);
  }
  (std::make_integer_sequence<int, Law::template kHistorySize<Dim>>{});
}

/// Packs the history of a contact: copies the numbers that the models of `Law` use.
template <class Law, int Dim>
PackedHistory<Law::template kHistorySize<Dim>> packed_history(const ContactHistory<Dim>& all) {
  PackedHistory<Law::template kHistorySize<Dim>> packed;
  if constexpr (Law::template kHistorySize<Dim> != 0)
    for_each_history<Law, Dim>([&](auto k, auto place) { packed.value[k] = all[place]; });
  return packed;
}

/// Unpacks the history of a contact to the order of HistoryLayout. Numbers that the models of `Law` do not use are set
/// to zero.
template <class Law, int Dim>
ContactHistory<Dim> unpacked_history(const PackedHistory<Law::template kHistorySize<Dim>>& packed) {
  ContactHistory<Dim> all = ContactHistory<Dim>::Zero();
  if constexpr (Law::template kHistorySize<Dim> != 0)
    for_each_history<Law, Dim>([&](auto k, auto place) { all[place] = packed.value[k]; });
  return all;
}

}  // namespace floc
