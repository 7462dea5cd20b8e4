#pragma once

#include <utility>

#include "floc/contact/history.h"
#include "floc/packing/contact.h"
#include "floc/packing/contact_order.h"

namespace floc {

/// Exchanges the two grains of a contact.
/// @param parity  factor by which each number in the history is multiplied, from swap_parity()
template <int Dim>
void swap_sides(const ContactHistory<Dim>& parity, Contact<Dim>& c) {
  c = swapped(c);
  c.normal = -c.normal;
  std::swap(c.arm_i, c.arm_j);
  c.shear_force = -c.shear_force;
  c.rolling_moment = -c.rolling_moment;
  c.history = c.history.cwiseProduct(parity);
}

}  // namespace floc
