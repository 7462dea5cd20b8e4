#pragma once

#include <vector>

#include "floc/base/vec.h"
#include "floc/contact/declaration.h"
#include "floc/contact/law.h"

namespace floc {

/// Layout of the history of a contact, both in the contact list and in the arrays of pairs in motion. Each slot
/// of the law has a place of its own with room for any of its models, so that a change of the law moves no
/// number.
template <int Dim>
struct HistoryLayout {
  // Largest history of a model of each slot, in numbers. history_layout.h checks that no model needs more.
  static constexpr int kNormalRoom = 2, kFrictionRoom = Dim == 2 ? 2 : 4, kRollingRoom = Dim == 2 ? 1 : 3,
                       kTwistingRoom = Dim == 2 ? 0 : 1, kAdhesionRoom = 1;

  static constexpr int kNormal = 0;
  static constexpr int kFriction = kNormal + kNormalRoom;
  static constexpr int kRolling = kFriction + kFrictionRoom;
  static constexpr int kTwisting = kRolling + kRollingRoom;
  static constexpr int kAdhesion = kTwisting + kTwistingRoom;
  static constexpr int kSize = kAdhesion + kAdhesionRoom;
};

/// History of a contact, at the places of the layout; zero at places that its law does not use.
template <int Dim>
using ContactHistory = Eigen::Matrix<double, HistoryLayout<Dim>::kSize, 1>;

/// One quantity of the history of contacts under a law.
struct HistoryQuantity {
  History declared;
  int begin;  ///< place of its first number in the layout
  int size;   ///< count of its numbers
};

/// Quantities of the history of contacts under a law, in the order of the layout.
std::vector<HistoryQuantity> history_quantities(const Law& law, int dim);

/// Factor of each number of the layout when the two grains of a contact are exchanged.
template <int Dim>
ContactHistory<Dim> swap_parity(const Law& law);

}  // namespace floc
