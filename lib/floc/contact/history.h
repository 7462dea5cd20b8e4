#pragma once

#include <vector>

#include "floc/base/vec.h"
#include "floc/contact/declaration.h"
#include "floc/contact/law.h"

namespace floc {

/// Order of the numbers in the history of a contact. This order is used in the list of contacts and in the arrays of
/// pairs of the dynamics. Each slot of the contact law (normal, friction, ...) has a fixed range of indices that is
/// large enough for any model of the slot. The numbers therefore keep their indices when the law changes.
template <int Dim>
struct HistoryLayout {
  // Number of values reserved for each slot of the contact law: the size of the largest history among the models of the
  // slot. history_layout.h checks that no model needs more.
  static constexpr int kNormalRoom = 2, kFrictionRoom = Dim == 2 ? 2 : 4, kRollingRoom = Dim == 2 ? 1 : 3,
                       kTwistingRoom = Dim == 2 ? 0 : 1, kAdhesionRoom = 1;

  static constexpr int kNormal = 0;
  static constexpr int kFriction = kNormal + kNormalRoom;
  static constexpr int kRolling = kFriction + kFrictionRoom;
  static constexpr int kTwisting = kRolling + kRollingRoom;
  static constexpr int kAdhesion = kTwisting + kTwistingRoom;
  static constexpr int kSize = kAdhesion + kAdhesionRoom;
};

/// History of a contact: numbers in the order of HistoryLayout. Numbers that the contact law does not use are zero.
template <int Dim>
using ContactHistory = Eigen::Matrix<double, HistoryLayout<Dim>::kSize, 1>;

/// One quantity in the history of a contact, such as the elongation of the tangential spring.
struct HistoryQuantity {
  History declared;
  int begin;  ///< index of the first number of the quantity in a ContactHistory
  int size;   ///< number of values of this quantity
};

/// Returns the quantities that a contact law stores per contact, in the order of HistoryLayout.
std::vector<HistoryQuantity> history_quantities(const Law& law, int dim);

/// Returns the factor (1 or -1) by which each number in the history of a contact is multiplied when the two grains of
/// the contact are exchanged.
template <int Dim>
ContactHistory<Dim> swap_parity(const Law& law);

}  // namespace floc
