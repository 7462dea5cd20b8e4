#pragma once

#include <algorithm>

#include "floc/neighbors/space_order.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/pair_arrays.h"
#include "support/dynamics.h"

namespace floc::test {

/// Gas of spheres in an elongated cell, and the list of close pairs in the format of the force loop.
struct ListedGas {
  enum class Sizes { equal, unequal };

  explicit ListedGas(int n, int blocks_of_group = 1, Sizes sizes = Sizes::equal)
      : gas(gas_with(n, sizes)),
        grains(gas.grains, space_order(gas.cell, gas.grains)),
        pairs_(close_pairs(), Partner::grain, grains, *laws_of_same_rows({gas.law})[0], 1e-4, blocks_of_group) {
  }

  int n_blocks() const { return (grains.size() + kGrainBlock - 1) / kGrainBlock; }
  const PairArrays<3>& pairs() const { return pairs_; }
  PairView<3> pair_view() { return pairs_.view(); }

  Packing<3> gas;
  GrainArrays<3> grains;

 private:
  static constexpr int kCopies = 24;

  static Packing<3> gas_with(int n, Sizes sizes) {
    GrainOptions grains;
    grains.count = n / kCopies;
    grains.diameter.min = sizes == Sizes::equal ? 1.0 : 0.5;
    grains.diameter.max = 1.0;
    RandomStream random(1, 1);
    return tiled<3>(make_gas<3>(grains, cohesive_law(), 0.3, random), {1, 1, kCopies});
  }
  std::vector<NeighborPair<3>> close_pairs() const {
    Grains<3> ordered = Grains<3>::with_size(grains.size());
    grains.copy_positions_to(ordered);
    std::copy_n(grains.radius.begin(), grains.size(), ordered.radius.begin());
    return find_pairs(gas.cell, ordered, 0.4);
  }

  PairArrays<3> pairs_;
};

}  // namespace floc::test
