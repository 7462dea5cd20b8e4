#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "floc/base/error.h"
#include "floc/network/carrying_structure.h"
#include "floc/network/rattlers.h"
#include "floc/structure/axis_profile.h"
#include "floc/structure/bond_signs.h"
#include "floc/structure/coordination.h"
#include "floc/structure/coverage.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/pair_correlation.h"
#include "floc/structure/phase_structure.h"
#include "floc/structure/porosity_probe.h"
#include "floc/structure/rigid_clusters.h"
#include "floc/structure/scattering.h"
#include "support/network_packings.h"

/// Tests that the library itself refuses invalid arguments of its functions. The checks of the program are not
/// involved.
namespace floc::test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kInf = std::numeric_limits<double>::infinity();
const std::vector<double> kNeverPositive = {std::nan(""), kInf, -kInf, -1.0, 0.0};
const std::vector<double> kNeverNegative = {std::nan(""), kInf, -kInf, -1.0};

Packing<2> some_disks() {
  return random_packing<2>(20, 1, elastic_law(100.0, 100.0, 0.0));
}

/// An argument of a function: its name, and a call of the function with a given value of this argument.
struct Argument {
  const char* name;
  std::function<void(double)> call;
  std::vector<double> refused;
};

TEST(Ranges, OfRealNumbersAreTheLibrarys) {
  const Packing<2> disks = some_disks();
  const auto with = [&disks](auto change) {
    return [&disks, change](double x) {
      ScatteringOptions options;
      change(options, x);
      (void)scattering(disks, options);
    };
  };
  const std::vector<Argument> arguments = {
      {"reach", [&](double x) { (void)pair_correlation(disks, x, 10); }, kNeverPositive},
      {"reach", [&](double x) { (void)pair_correlation(disks, x, 10); }, {1e5, 1e300}},
      {"bin_width", [&](double x) { (void)distribution_of({1.0}, 1.0, x); }, kNeverPositive},
      {"bin_width", [&](double x) { (void)force_distribution(disks, ForceKind::normal, ForceUnit::mean, x); },
       kNeverPositive},
      {"near", [&](double x) { (void)bond_signs(disks, x); }, kNeverNegative},
      {"zero_force", [&](double x) { (void)coordination(disks, x); }, kNeverNegative},
      {"smallest_force", [&](double x) { (void)carrying_structure(disks, x, 2); }, kNeverNegative},
      {"smallest_force", [&](double x) { (void)find_rattlers(disks, x); }, kNeverNegative},
      {"rigid_tolerance",
       [&](double x) { (void)rigid_clusters(disks, disks, contact_changes(disks, disks), x); }, kNeverPositive},
      {"largest_k", with([](ScatteringOptions& o, double x) { o.largest = x; }), kNeverPositive},
      {"cells_per_wave", with([](ScatteringOptions& o, double x) { o.cells_per_wave = x; }), kNeverPositive},
      {"cells_per_wave", with([](ScatteringOptions& o, double x) { o.cells_per_wave = x; }), {3.9, 1001.0}},
      {"bin_growth", with([](ScatteringOptions& o, double x) { o.bin_growth = x; }), {std::nan(""), 1.0, 0.5}}};
  int n = 0;
  for (const Argument& argument : arguments)
    for (const double x : argument.refused) {
      ++n;
      EXPECT_THAT([&] { argument.call(x); },
                  ThrowsMessage<InputError>(HasSubstr(std::string(argument.name) + " = ")))
          << argument.name << " = " << x;
    }
  std::cout << arguments.size() << " arguments, " << n << " calls\n";
}

TEST(Ranges, OfWholeNumbersAreTheLibrarys) {
  const Packing<2> disks = some_disks();
  const ContactNetwork<2> network = contact_network(disks);
  const std::vector<double> pressure(disks.grains.radius.size(), 1.0);
  const auto phases = [&](PhaseOptions options) {
    (void)phase_structure(network, disks.cell, pressure, options);
  };
  const std::vector<std::pair<const char*, std::function<void(int)>>> calls = {
      {"slices", [&](int n) { (void)axis_profile(disks, 0, n, {}); }},
      {"probes", [&](int n) { (void)porosity_probes(disks, n); }},
      {"n_bins", [&](int n) { (void)pair_correlation(disks, 1.0, n); }},
      {"mesh cells along a lattice vector",
       [&](int n) {
         (void)coverage_map(disks, {n, 3});
       }},
      {"mesh cells along a lattice vector",
       [&](int n) {
         (void)coverage_map(disks, {3, n});
       }},
      {"least_contacts", [&](int n) { (void)carrying_structure(disks, 0.0, n); }},
      {"shuffles", [&](int n) { phases({.n_shuffles = n}); }},
      {"n_bins", [&](int n) { phases({.n_bins = n}); }},
      {"most_vectors", [&](int n) { (void)scattering(disks, {.most_vectors = n}); }}};
  for (const auto& [name, call] : calls)
    for (const int n : {-5, -1, 0})
      EXPECT_THAT(([&call = call, n] { call(n); }),
                  ThrowsMessage<InputError>(HasSubstr(std::string(name) + " = ")))
          << name << " = " << n;
  EXPECT_THROW((void)axis_profile(disks, 0, 2'000'000'000, {}), InputError);
  EXPECT_THROW((void)porosity_probes(disks, 2'000'000'000), InputError);
}

}  // namespace
}  // namespace floc::test
