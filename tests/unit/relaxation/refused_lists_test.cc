#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

/// Shrinks the cell of a packing of very soft grains, until each grain has more neighbours than a neighbour list can
/// contain.
template <int Dim>
void close_upon(int n_threads) {
  Law law;
  law += test::linear(1e-6);
  const Packing<Dim> gas = test::gas_of<Dim>(130, law, 0.4);
  BoundaryControl<Dim> control = BoundaryControl<Dim>::fixed();
  control.target.template head<Dim>().setConstant(1.0);
  const auto dynamics = make_dynamics(gas, control, {0.02, 0.05, n_threads});
  dynamics->advance(300, Motion::free);
}

/// If a thread finds an error while it builds neighbour lists, the whole team of threads must throw this error.
TEST(ExplicitDynamics, CarriesOutWhatListsOfNeighboursRefuseInMotion) {
  const auto refused = testing::ThrowsMessage<InputError>(
      testing::HasSubstr("the grains overlap so much, or attract each other across such wide gaps"));
  for (const int n_threads : {1, 2}) {
    EXPECT_THAT([&] { close_upon<2>(n_threads); }, refused) << n_threads;
    EXPECT_THAT([&] { close_upon<3>(n_threads); }, refused) << n_threads;
  }
}

}  // namespace
}  // namespace floc
