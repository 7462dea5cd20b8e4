#include "floc/relaxation/kernels/kernel_law.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <type_traits>
#include <variant>
#include <vector>

#include "floc/contact/history_layout.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/kernels/pair_kernel.h"
#include "floc/relaxation/pair_arrays.h"
#include "support/laws.h"

namespace floc {
namespace {

using test::for_each_law_and_dimension;

/// Moves a pair of grains of unit mass and diameter under a law, step by step.
template <int Dim, class Law>
class PairUnder {
 public:
  /// @param liquid  whether the pair has a liquid bridge, for laws with liquid
  PairUnder(const Law& law, double damping, bool liquid) : law_(law), damping_(damping) {
    ContactHistory<Dim> all = ContactHistory<Dim>::Zero();
    if (Law::kHoldsLiquid && liquid) all[HistoryLayout<Dim>::kAdhesion] = 1e-6;
    memory_ = packed_history<Law, Dim>(all);
    parameters_ = law_.template pair_parameters<Dim>(0.5, 0.5, memory_);
  }

  ContactForces<Dim> move(ContactMotion<Dim> motion) {
    motion.damping = damping_;
    return law_.template respond<Dim, double>(motion, memory_, parameters_);
  }
  ContactHistory<Dim> history() const { return unpacked_history<Law, Dim>(memory_); }

 private:
  Law law_;
  double damping_;
  PackedHistory<Law::template kHistorySize<Dim>> memory_;
  typename Law::template PairParameters<> parameters_;
};

/// Returns motions of a pair: into contact, within contact, out of contact, and to a gap of exactly zero.
template <int Dim>
std::vector<ContactMotion<Dim>> motions() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<ContactMotion<Dim>> all;
  for (int k = 0; k < 60; ++k) {
    const double gap = k % 10 == 0 ? 0.0 : 2e-3 * number(random);
    ContactMotion<Dim> motion{PairGeometry<>(gap, 0.25, 0.5), number(random), 0.0, Shear<Dim>::Zero(),
                              RotationVector<Dim>::Zero()};
    for (double& slip : motion.slip) slip = 1e-3 * number(random);
    for (double& rotation : motion.relative_rotation) rotation = 1e-3 * number(random);
    motion.twist = 1e-3 * number(random);
    all.push_back(motion);
  }
  return all;
}

template <int Dim, class Law>
void expect_same_forces(const Law& law, Partner partner) {
  const double damping = law.damping_coefficient(CollisionMass::between(1.0, 1.0));
  std::visit(
      [&]<class Completed>(const Completed& completed) {
        PairUnder<Dim, Law> pair(law, damping, partner == Partner::grain);
        PairUnder<Dim, Completed> same(completed, damping, partner == Partner::grain);
        for (const ContactMotion<Dim>& motion : motions<Dim>()) {
          const ContactForces<Dim> f = pair.move(motion), g = same.move(motion);
          EXPECT_EQ(f.normal.force(), g.normal.force()) << "at a gap of " << motion.pair.gap;
          EXPECT_EQ(f.viscous, g.viscous);
          EXPECT_EQ(f.shear, g.shear);
          EXPECT_EQ(f.rolling, g.rolling);
          EXPECT_EQ(f.twisting, g.twisting);
          EXPECT_EQ(pair.history(), same.history());
        }
      },
      kernel_law<Dim>(law, partner));
}

TEST(KernelLaw, GivesTheBitsOfTheLawThatItCompletes) {
  for_each_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int kDim = decltype(dimension)::value;
    expect_same_forces<kDim>(law, Partner::grain);
    SCOPED_TRACE("between grains and walls");
    expect_same_forces<kDim>(law, Partner::wall);
  });
}

TEST(KernelLaw, OfWallsHasNoLiquid) {
  for_each_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int kDim = decltype(dimension)::value;
    std::visit([]<class Completed>(const Completed&) { EXPECT_TRUE((kServesWalls<Completed, kDim>)); },
               kernel_law<kDim>(law, Partner::wall));
  });
}

/// Normal law with a constant stiffness. It does not declare a kernel.
struct PlainRepulsion : LinearRepulsion {};

template <class Adhesion, class Damping, class Friction, class Rolling, class Twisting>
using PlainLaw = ContactLaw<PlainRepulsion, Adhesion, Damping, Friction, Rolling, Twisting>;

TEST(KernelLaw, OfANewNormalLawIsTheSameForMostLaws) {
  using Disks = PlainLaw<DryAttraction, ViscousDamping, CoulombFriction, RollingSpring, NoTwisting>;
  using Spheres = PlainLaw<DryAttraction, ViscousDamping, CoulombFriction, RollingSpring, TwistingSpring>;
  using Bare = PlainLaw<NoAdhesion, NoDamping, NoFriction, NoRolling, NoTwisting>;
  using Sticky = PlainLaw<TailAdhesion, ViscousDamping, CoulombFriction, NoRolling, NoTwisting>;
  EXPECT_TRUE((std::is_same_v<KernelLawOf<Bare, 2>, Disks>));
  EXPECT_TRUE((std::is_same_v<KernelLawOf<Sticky, 2>, Disks>));
  EXPECT_TRUE((std::is_same_v<KernelLawOf<Sticky, 2, Partner::wall>, Disks>));
  EXPECT_TRUE((std::is_same_v<KernelLawOf<Bare, 3>, Spheres>));
  EXPECT_TRUE((std::is_same_v<KernelLawOf<Sticky, 3>, Spheres>));
  EXPECT_TRUE((std::is_same_v<KernelLawOf<Sticky, 3, Partner::wall>, Spheres>));
}

/// Returns a row of overlapping grains that move and spin.
template <int Dim>
Grains<Dim> row_of_grains(int n) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Grains<Dim> grains = Grains<Dim>::with_size(n);
  grains.radius.assign(n, 0.5);
  grains.mass.assign(n, 1.0);
  for (int i = 0; i < n; ++i) {
    for (int a = 0; a < Dim; ++a) grains.position[i][a] = (a == 0 ? 0.999 * i : 0.0) + 1e-4 * number(random);
    for (double& v : grains.velocity[i]) v = number(random);
    for (double& spin : grains.angular_velocity[i]) spin = number(random);
  }
  return grains;
}

/// Forces and history of a row of grains, computed by a portable kernel.
template <int Dim, class KernelLaw>
struct Computed {
  PairArrays<Dim> pairs;
  std::vector<double> rows;

  Computed(const KernelLaw& kernel_law, const LawParameters& law, int n) {
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    GrainArrays<Dim> grains(row_of_grains<Dim>(n), order);
    std::vector<NeighborPair<Dim>> neighbors;
    for (int k = 0; k + 1 < n; ++k) neighbors.push_back({k, k + 1, Vec<Dim, int>::Zero()});
    pairs = PairArrays<Dim>(neighbors, Partner::grain, grains, ComposedLaw{compose_law(law)}, 1e-3, 1);
    PairView<Dim> view = pairs.view();
    rows.assign(kRow * pairs.size(), -1.0);
    view.row = rows.data();
    PairCell<Dim> cell{{}, {}, 1e-3, {}};
    for (int a = 0; a < Dim; ++a) cell.lattice[a][a] = 100.0;
    const AlignedVector<double> skins(grains.x[0].size(), 1.0);
    for (int step = 0; step < 3; ++step)
      PairKernel<Portable, Dim, GrainsInTriangularLattice, KernelLaw>::compute(
          &kernel_law, grains.view(grains.x, skins), view, 0, pairs.size(), cell);
  }

  Vec<Dim> force(int pair) const {
    return Eigen::Map<const Vec<Dim>>(rows.data() + kRow * pair +
                                      RowLayout<Dim, kRowKind<KernelLaw, Dim>>::kForce);
  }

  static constexpr int kRow = RowLayout<Dim, kRowKind<KernelLaw, Dim>>::kSize;
};

template <int Dim>
void expect_forces_alone() {
  constexpr int kGrains = 30;
  LawParameters law;
  law.normal = LinearRepulsion{100.0};
  const ContactLaw<LinearRepulsion, NoAdhesion, NoDamping, NoFriction, NoRolling, NoTwisting> special{
      {100.0}, {}, {}, {}, {}, {}};
  using General = KernelLawOf<PlainLaw<NoAdhesion, NoDamping, NoFriction, NoRolling, NoTwisting>, Dim>;
  General general{{{100.0}}, {}, kNeutral<ViscousDamping>, kNeutral<CoulombFriction>, kNeutral<RollingSpring>,
                  {}};
  if constexpr (Dim == 3) general.twisting = kNeutral<TwistingSpring>;
  const Computed<Dim, std::decay_t<decltype(special)>> expected(special, law, kGrains);
  const Computed<Dim, General> computed(general, law, kGrains);
  EXPECT_TRUE(computed.pairs.viscous.empty());
  using Layout = RowLayout<Dim, RowKind::moments>;
  for (int p = 0; p < kGrains - 1; ++p) {
    EXPECT_GT(computed.force(p).norm(), 0.0);
    EXPECT_EQ(computed.force(p), expected.force(p));
    for (int a = 0; a < kRotations<Dim>; ++a) {
      EXPECT_EQ(computed.rows[Layout::kSize * p + Layout::kMomentI + a], 0.0);
      EXPECT_EQ(computed.rows[Layout::kSize * p + Layout::kMomentJ + a], 0.0);
    }
  }
}

TEST(GeneralKernel, NeedsNoMemoryThatTheLawOfTheSceneLacks) {
  expect_forces_alone<2>();
  expect_forces_alone<3>();
}

}  // namespace
}  // namespace floc
