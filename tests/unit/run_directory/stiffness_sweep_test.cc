#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "floc/base/error.h"
#include "floc/io/law_text.h"
#include "floc/io/listed_packing.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/law/stiffness_check.h"
#include "floc/verification/verification.h"
#include "support/contact_laws.h"
#include "support/law_list.h"

/// Another program may give stiffnesses that differ from those of the contact law. These tests check that floc reports
/// and refuses the differences: in contact lists, in states read for moduli, and in verification. The tests cover every
/// law in both dimensions, every stiffness of a contact and several factors.
namespace floc {
namespace {

using testing::HasSubstr;

const std::map<std::string, double> kNumbers = {{"normal.stiffness", 1e5},
                                                {"normal.modulus", 1e6},
                                                {"normal.poisson", 0.3},
                                                {"adhesion.force", 1.25},
                                                {"adhesion.range", 1e-2},
                                                {"adhesion.surface_tension", 0.4},
                                                {"adhesion.contact_angle", 20.0},
                                                {"adhesion.water_content", 1e-3},
                                                {"adhesion.density_ratio", 2.5},
                                                {"damping.restitution", 0.3},
                                                {"damping.critical_fraction", 0.4},
                                                {"friction.coefficient", 0.5},
                                                {"friction.stiffness", 0.8e5},
                                                {"rolling.coefficient", 0.05},
                                                {"rolling.stiffness", 30.0},
                                                {"twisting.coefficient", 0.04},
                                                {"twisting.stiffness", 20.0}};
constexpr double kFactors[] = {2.0, 10.0, 0.5, 2.0 / 3.0, 1.5, 1.001, 0.999};

/// Two grains with an overlap of 1e-3, and a third grain at a gap within the range of attraction.
template <int Dim>
Packing<Dim> pair_and_neighbour(const Law& law) {
  Packing<Dim> packing;
  packing.law = law;
  packing.cell.matrix *= 7.0;
  packing.grains = Grains<Dim>::with_size(3);
  for (int i = 0; i < 3; ++i) {
    packing.grains.position[i].setConstant(1.0);
    packing.grains.position[i][0] = 1.0 + i * 0.999 + (i == 2 ? 0.005 : 0.0);
    packing.grains.radius[i] = 0.5;
    packing.grains.mass[i] = 1.0;
  }
  find_contacts(packing);
  return packing;
}

double* stiffness(ListedContact& row, std::size_t kind) {
  std::optional<double>* const members[] = {&row.kn, &row.kt, &row.kr, &row.ktw};
  return &members[kind]->emplace(0.0);
}
template <int Dim>
double* stiffness(Contact<Dim>& c, std::size_t kind) {
  double* const members[] = {&c.kn, &c.kt, &c.kr, &c.ktw};
  return members[kind];
}

/// Returns the differences of stiffnesses that are reported for a contact list with a single contact, the touching one.
/// @param factor  factor by which the list multiplies the stiffness `kind`
template <int Dim>
std::vector<std::string> said_of_list(const Packing<Dim>& packing, std::size_t kind, double factor) {
  ListedPacking listed;
  listed.place = "list", listed.cell_place = "cell", listed.law = packing.law;
  for (int a = 0; a < Dim; ++a) {
    listed.cell.emplace_back(Dim, 0.0);
    listed.cell.back()[static_cast<std::size_t>(a)] = packing.cell.matrix(a, a);
  }
  for (int i = 0; i < 3; ++i) {
    ListedGrain& grain = listed.grains.emplace_back();
    grain.id = i;
    grain.position.template head<Dim>() = packing.grains.position[i];
    grain.radius = 0.5;
  }
  ListedContact row;
  row.id1 = 0, row.id2 = 1;
  row.normal_force = packing.contacts[0].normal_force;
  const Stiffnesses own = stiffnesses(packing.contacts[0]);
  for (std::size_t k = 0; k < own.size(); ++k)
    if (k != 3 || packing.law.has_twisting()) *stiffness(row, k) = own[k] * (k == kind ? factor : 1.0);
  listed.contacts = {row};
  return assemble(listed).listed_contacts.stiffness_differences;
}

template <int Dim>
Criterion law_criterion(const Packing<Dim>& packing) {
  State<Dim> state;
  state.packing = packing;
  measure(state);
  for (const Criterion& c : verify_equilibrium(state))
    if (c.name == std::string("law")) return c;
  ADD_FAILURE();
  return {};
}

struct Counts {
  int laws = 0, lists = 0, states = 0, verified = 0;
};

template <int Dim>
void sweep(const Law& law, Counts& counts) {
  SCOPED_TRACE(fmt::format("{} in {}D", law_text(law), Dim));
  const Packing<Dim> packing = pair_and_neighbour<Dim>(law);
  ASSERT_FALSE(packing.contacts.empty());
  ++counts.laws;
  EXPECT_EQ(stiffness_differences(packing), "");
  EXPECT_TRUE(law_criterion(packing).holds) << law_criterion(packing).where;
  for (std::size_t kind = 0; kind < kStiffnessNames.size(); ++kind) {
    const std::string name = kStiffnessNames[kind];
    SCOPED_TRACE(name);
    EXPECT_THAT(said_of_list(packing, kind, 1.0), testing::IsEmpty());
    for (std::size_t k = 0; k < packing.contacts.size(); ++k) {
      if (stiffnesses(packing.contacts[k])[kind] == 0.0) continue;
      for (const double factor : kFactors) {
        SCOPED_TRACE(factor);
        Packing<Dim> changed = packing;
        *stiffness(changed.contacts[k], kind) *= factor;
        EXPECT_THAT(stiffness_differences(changed),
                    HasSubstr(fmt::format("{} of 1 contact is {:.4g} times the value of the contact law", name,
                                          factor)));
        const Criterion criterion = law_criterion(changed);
        EXPECT_FALSE(criterion.holds || criterion.by_value);
        EXPECT_THAT(criterion.where, HasSubstr(fmt::format("by the stiffness {} = ", name)));
        ++counts.states, ++counts.verified;
        if (k > 0) continue;
        EXPECT_THAT(said_of_list(packing, kind, factor),
                    testing::ElementsAre(HasSubstr(fmt::format(
                        "{} of 1 contact is {:.4g} times the value of the contact law", name, factor))));
        ++counts.lists;
      }
      // a change in the last bit passes, a relative change of 1e-9 does not
      for (const double direction : {0.0, 2.0}) {
        Packing<Dim> changed = packing;
        double& value = *stiffness(changed.contacts[k], kind);
        value = std::nextafter(value, direction * value);
        EXPECT_TRUE(law_criterion(changed).holds) << law_criterion(changed).where;
        value *= direction == 0.0 ? 1.0 - 1e-9 : 1.0 + 1e-9;
        EXPECT_FALSE(law_criterion(changed).holds);
        counts.verified += 2;
      }
    }
  }
}

TEST(Stiffnesses, OfEveryLawAreComparedWithItInListsAndStates) {
  Counts counts;
  for (const Law& law : test::all_laws(2, kNumbers))
    if (!law.is_rigid()) sweep<2>(law, counts);
  for (const Law& law : test::all_laws(3, kNumbers))
    if (!law.is_rigid()) sweep<3>(law, counts);
  fmt::print("{} laws of 2D and 3D, {} stiffnesses: {} lists, {} states for moduli, {} verified\n", counts.laws,
             kStiffnessNames.size(), counts.lists, counts.states, counts.verified);
  EXPECT_GT(counts.laws, 40);
}

TEST(Stiffnesses, OfHertzThatAreForceOverOverlapAreNamed) {
  Law law;
  law += test::hertz(1e6, 0.3);
  EXPECT_THAT(
      said_of_list(pair_and_neighbour<3>(law), 0, 2.0 / 3.0),
      testing::ElementsAre(testing::AllOf(HasSubstr("0.6667 times"), HasSubstr("the value is N/delta"))));
}

TEST(Stiffnesses, ThatTheLawDoesNotHaveAreSaidOrRefused) {
  Law law;
  law += test::linear(1e5);
  const Packing<3> packing = pair_and_neighbour<3>(law);
  const auto listed = [&](std::optional<double> ListedContact::*member, double value) {
    ListedPacking list;
    list.place = "list", list.cell_place = "cell", list.law = law,
    list.cell = {{7, 0, 0}, {0, 7, 0}, {0, 0, 7}};
    for (int i = 0; i < 2; ++i) {
      list.grains.emplace_back();
      list.grains.back().id = i, list.grains.back().radius = 0.5;
      list.grains.back().position = packing.grains.position[i];
    }
    ListedContact row;
    row.id2 = 1, row.normal_force = packing.contacts[0].normal_force, row.*member = value;
    list.contacts = {row};
    return assemble(list).listed_contacts.stiffness_differences;
  };
  EXPECT_THAT(listed(&ListedContact::kt, 0.0), testing::IsEmpty());
  EXPECT_THAT(
      listed(&ListedContact::kt, 5.0),
      testing::ElementsAre(HasSubstr("kt of 1 contact is not zero, but it is zero by the contact law")));
  EXPECT_THROW(listed(&ListedContact::kr, 5.0), InputError);
  EXPECT_THROW(listed(&ListedContact::ktw, 5.0), InputError);
  for (const double none : {0.0, -1.0, -1e5})
    EXPECT_THROW(listed(&ListedContact::kn, none), InputError) << none;
  for (const auto member : {&ListedContact::kt, &ListedContact::kr, &ListedContact::ktw})
    EXPECT_THROW(listed(member, -1.0), InputError);
}

}  // namespace
}  // namespace floc
