#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "floc/elasticity/moduli.h"
#include "floc/io/import.h"
#include "floc/io/law_text.h"
#include "floc/packing/law/contact_forces.h"
#include "support/hand_network.h"
#include "support/places.h"

/// Packings that LAMMPS and YADE have simulated under laws that floc has too (data/packings), converted as described in
/// docs/commands/convert.md. At the positions in the files, the laws must give the normal forces in the files. The
/// moduli must equal those of a network that is built directly from the rows of the files.
namespace floc::test {
namespace {

const std::string kData = source_directory() + "/data/packings/";
constexpr double kRelative = 1e-10;

Imported imported(const std::string& grains, const std::string& contacts, const std::string& law,
                  const std::string& columns = "") {
  ImportOptions options;
  if (!law.empty()) options.law = parse_law("--law", law);
  options.contacts = kData + contacts;
  std::istringstream items(columns);
  for (std::string item; std::getline(items, item, ',');)
    options.contact_columns[item.substr(0, item.find('='))] = item.substr(item.find('=') + 1);
  return find_import_format("", kData + grains).read(kData + grains, options);
}

std::string lammps_columns(int dimension) {
  std::string text = "id1=c_pair[1],id2=c_pair[2]";
  for (int a = 1; a <= dimension; ++a)
    text += ",force" + std::to_string(a) + "=c_force[" + std::to_string(a) + "],shear_force" +
            std::to_string(a) + "=c_force[" + std::to_string(a + 3) + "]";
  return text;
}

/// Returns grains by id.
/// @param x, radius  column of the first coordinate, and column of the radius
std::map<std::int64_t, HandGrain> grains_of(const std::vector<std::vector<double>>& rows, int x, int radius) {
  std::map<std::int64_t, HandGrain> grains;
  for (const std::vector<double>& row : rows)
    grains[static_cast<std::int64_t>(row[0])] = {{row[x], row[x + 1], row[x + 2]}, row[radius]};
  return grains;
}

/// Returns the cell of a dump. The dump gives the bounds of the cell in three lines, with tilt factors if the cell is
/// tilted.
Mat<3> lammps_cell(const std::string& dump) {
  const auto rows = numbers_behind(dump, "ITEM: BOX BOUNDS");
  const auto tilt = [&](int a) { return rows[a].size() > 2 ? rows[a][2] : 0.0; };
  const double xy = tilt(0), xz = tilt(1), yz = tilt(2);
  Mat<3> cell = Mat<3>::Zero();
  cell(0, 0) = rows[0][1] - rows[0][0] - (std::max({0.0, xy, xz, xy + xz}) - std::min({0.0, xy, xz, xy + xz}));
  cell(1, 1) = rows[1][1] - rows[1][0] - (std::max(0.0, yz) - std::min(0.0, yz));
  cell(2, 2) = rows[2][1] - rows[2][0];
  cell(1, 0) = xy, cell(2, 0) = xz, cell(2, 1) = yz;
  return cell;
}

/// Function of the gap and the reduced radius that returns the stiffnesses of a pair; absent if the pair does not
/// interact.
using HandLaw = std::function<std::optional<HandContact>(double gap, double radius)>;

/// Returns the moduli of the network that consists of the listed pairs.
template <int Dim>
Moduli by_hand(HandNetwork<Dim> hand, const std::vector<std::vector<double>>& pairs, const HandLaw& law) {
  for (const std::vector<double>& row : pairs) {
    const auto id1 = static_cast<std::int64_t>(row[0]), id2 = static_cast<std::int64_t>(row[1]);
    if (const auto k = law(hand.gap(id1, id2), hand.reduced_radius(id1, id2))) hand.add(id1, id2, *k);
  }
  return elastic_moduli(hand.network, NetworkLoad<Dim>{}, {});
}

template <int Dim>
void expect_same_moduli(const Imported& converted, const Moduli& hand) {
  const Moduli moduli = elastic_moduli(std::get<State<Dim>>(converted.state).packing, {});
  EXPECT_GT(moduli.B, 0.0);
  EXPECT_GT(moduli.G, 0.0);
  EXPECT_NEAR(moduli.B, hand.B, kRelative * hand.B);
  EXPECT_NEAR(moduli.G, hand.G, kRelative * hand.G);
}

/// Returns the largest difference between the stored normal forces and the forces that the law gives, divided by the
/// largest force.
template <int Dim>
double largest_difference(const Imported& converted) {
  const Packing<Dim>& packing = std::get<State<Dim>>(converted.state).packing;
  double difference = 0.0, largest = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    Contact<Dim> by_law = c;
    refresh_contact(packing, by_law);
    difference = std::max(difference, std::abs(by_law.normal_force - c.normal_force));
    largest = std::max(largest, std::abs(c.normal_force));
  }
  return difference / largest;
}

/// Hertz-Mindlin law of spheres with Young's modulus E and Poisson's ratio nu. Contacts with forces below `smallest` =
/// 1e-5 P a^2 belong to rattlers and are omitted.
HandLaw hertz_mindlin(double E, double nu, double smallest) {
  return [=](double gap, double radius) -> std::optional<HandContact> {
    const double E_r = E / (2.0 * (1.0 - nu * nu));
    if (gap >= 0.0 || 4.0 / 3.0 * E_r * std::sqrt(radius * -gap) * -gap < smallest) return std::nullopt;
    const double a = std::sqrt(-gap * radius);  // radius of the contact area
    return HandContact{E / (1.0 - nu * nu) * a, 2.0 * E / ((1.0 + nu) * (2.0 - nu)) * a};
  };
}

class LammpsSpheres : public testing::TestWithParam<std::string> {};

TEST_P(LammpsSpheres, OfHertzAndMindlinGiveTheirForcesAndTheModuliOfTheNetworkEnteredByHand) {
  const std::string name = "lammps/" + GetParam();
  const Imported converted =
      imported(name + ".dump", name + ".contacts",
               "normal.modulus=1e5,normal.poisson=0.25,friction.law=mindlin,friction.coefficient=0.4",
               lammps_columns(3));
  EXPECT_LT(largest_difference<3>(converted), kRelative);
  const HandNetwork<3> hand(lammps_cell(kData + name + ".dump"),
                            grains_of(numbers_behind(kData + name + ".dump", "ITEM: ATOMS"), 1, 4));
  expect_same_moduli<3>(converted, by_hand(hand, numbers_behind(kData + name + ".contacts", "ITEM: ENTRIES"),
                                           hertz_mindlin(1e5, 0.25, 1e-4)));
}

INSTANTIATE_TEST_SUITE_P(Styles, LammpsSpheres, testing::Values("history", "granular"));

TEST(LammpsDisks, WithFrictionAndAttractionGiveTheirForcesAndTheModuliOfTheNetworkEnteredByHand) {
  const std::string name = "lammps/cohesive";
  const Imported converted = imported(name + ".dump", name + ".contacts",
                                      "normal.stiffness=1000,adhesion.law=constant,adhesion.force=1,"
                                      "friction.coefficient=0.5,friction.stiffness=800",
                                      lammps_columns(2));
  EXPECT_LT(largest_difference<2>(converted), kRelative);
  const Packing<2>& packing = std::get<State<2>>(converted.state).packing;
  EXPECT_GT(std::count_if(packing.contacts.begin(), packing.contacts.end(),
                          [](const Contact<2>& c) { return c.normal_force < 0.0; }),
            0);
  EXPECT_GT(packing.contacts.front().shear_force.norm(), 0.0);
  const HandNetwork<2> hand(lammps_cell(kData + name + ".dump").topLeftCorner<2, 2>(),
                            grains_of(numbers_behind(kData + name + ".dump", "ITEM: ATOMS"), 2, 5));
  expect_same_moduli<2>(converted,
                        by_hand(hand, numbers_behind(kData + name + ".contacts", "ITEM: ENTRIES"),
                                [](double gap, double) -> std::optional<HandContact> {
                                  return gap < 0.0 ? std::optional(HandContact{1000.0, 800.0}) : std::nullopt;
                                }));
}

/// Reads the cell and the grains that a YADE script wrote: the first line has the lattice vectors.
HandNetwork<3> yade_hand(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::istringstream numbers(line.substr(line.find("cell") + 4));
  Mat<3> cell;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) numbers >> cell(a, b);
  return {cell, grains_of(numbers_behind(file, ""), 1, 4)};
}

/// Compares the normal forces that YADE listed with the normal forces of the law. The forces after the conversion
/// cannot be compared: YADE's tangential forces have a small component along the branch, which the conversion adds to
/// the normal force.
double largest_difference_of_yade(const Imported& converted, const std::vector<std::vector<double>>& rows) {
  const Packing<3>& packing = std::get<State<3>>(converted.state).packing;
  std::map<std::pair<int, int>, double> listed;
  double largest = 0.0, difference = 0.0;
  for (const std::vector<double>& row : rows) {
    const double force = Eigen::Vector3d(row[5], row[6], row[7]).norm();
    listed[std::minmax(static_cast<int>(row[0]), static_cast<int>(row[1]))] = force;
    largest = std::max(largest, force);
  }
  EXPECT_EQ(listed.size(), packing.contacts.size());
  for (Contact<3> c : packing.contacts) {
    refresh_contact(packing, c);
    difference = std::max(difference, std::abs(c.normal_force - listed.at({c.i, c.j})));
  }
  return difference / largest;
}

TEST(YadeSpheres, OfHertzAndMindlinGiveTheirForcesAndTheModuliOfTheNetworkEnteredByHand) {
  const Imported converted = imported(
      "yade/hertz.txt", "yade/hertz.interactions",
      "normal.modulus=1e7,normal.poisson=0.25,friction.law=mindlin,friction.coefficient=0.42279321873816178");
  const auto rows = numbers_behind(kData + "yade/hertz.interactions", "");
  EXPECT_LT(largest_difference_of_yade(converted, rows), kRelative);
  expect_same_moduli<3>(converted,
                        by_hand(yade_hand(kData + "yade/hertz.txt"), rows, hertz_mindlin(1e7, 0.25, 1e-5)));
}

TEST(YadeSpheres, WithFrictionAndCohesionGiveTheModuliOfTheNetworkEnteredByHand) {
  const Imported converted = imported(
      "yade/cohesive.txt", "yade/cohesive.interactions",
      "normal.stiffness=1e5,adhesion.law=constant,adhesion.force=10,friction.coefficient=0.42279321873816178,"
      "friction.stiffness=4e4");
  const auto rows = numbers_behind(kData + "yade/cohesive.interactions", "");
  HandNetwork<3> hand = yade_hand(kData + "yade/cohesive.txt");
  int n_pulling = 0;
  for (const std::vector<double>& row : rows) {  // columns: id1 id2 cellx celly cellz fn fs kn ks ...
    const auto id1 = static_cast<std::int64_t>(row[0]), id2 = static_cast<std::int64_t>(row[1]);
    hand.add(id1, id2, {row[11], row[12]});
    n_pulling += hand.gap(id1, id2) > 0.0;
  }
  EXPECT_GT(n_pulling, 0);
  expect_same_moduli<3>(converted, elastic_moduli(hand.network, NetworkLoad<3>{}, {}));
}

}  // namespace
}  // namespace floc::test
