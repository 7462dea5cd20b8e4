#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <sstream>

#include "floc/base/read_file.h"
#include "floc/elasticity/moduli.h"
#include "floc/imports/complete_import.h"
#include "floc/io/law_text.h"
#include "floc/packing/balance.h"
#include "floc/packing/wall_forces.h"
#include "support/places.h"

/// Packings of LAMMPS and YADE between walls and on floors (data/packings), converted as in docs/commands/convert.md.
/// The forces on walls, the net forces and the moduli must equal values that this test computes from the rows of the
/// files. This test uses neither the readers nor the contact search, the network or the solver of the library.
namespace floc::test {
namespace {

using Vector = Eigen::Vector3d;
const std::string kFiles = source_directory() + "/data/packings/";
constexpr double kAgreement = 1e-9;

/// Returns the rows of numbers, without comments, that follow a line beginning with `header` in a compressed text.
/// Names of walls, such as "x-", become the numbers -1 to -6.
std::vector<std::vector<double>> rows_behind(const std::string& file, const std::string& header) {
  std::istringstream in(read_file(kFiles + file));
  std::vector<std::vector<double>> rows;
  bool behind = header.empty();
  for (std::string line; std::getline(in, line);) {
    if (behind && !line.empty() && line[0] != '#') {
      std::vector<double>& row = rows.emplace_back();
      std::istringstream words(line);
      for (std::string word; words >> word;) {
        const std::size_t axis = std::string("xyz").find(word[0]);
        row.push_back(axis == std::string::npos ? std::strtod(word.c_str(), nullptr)
                                                : -1.0 - 2.0 * static_cast<double>(axis) - (word[1] == '+'));
      }
    }
    behind = behind || line.starts_with(header);
  }
  return rows;
}

/// A contact of a file: the force on the first grain, and the stiffnesses. A negative second body is a wall.
struct FileContact {
  std::int64_t id1, id2;
  Vector force;
  double kn, kt;
  bool on_wall() const { return id2 < 0; }
  int axis() const { return static_cast<int>(-1 - id2) / 2; }
  int side() const { return (-1 - id2) % 2 == 0 ? -1 : 1; }
};

/// Content of the files of a packing. The axes marked in `walls` have walls at one or both ends; the other axes are
/// periodic.
struct FilePacking {
  struct Grain {
    Vector x;
    double radius, mass;
  };
  std::map<std::int64_t, Grain> grains;
  std::vector<FileContact> contacts;
  Vector low, high, gravity;
  std::array<bool, 3> walls{};

  double volume() const { return (high - low).prod(); }
  /// Returns a vector from the centre of the first grain: to the centre of the nearest image of the second grain or,
  /// for a contact with a wall, to the nearest point of the wall.
  Vector branch(const FileContact& c) const {
    const Vector& x = grains.at(c.id1).x;
    if (c.on_wall()) return ((c.side() < 0 ? low : high)[c.axis()] - x[c.axis()]) * Vector::Unit(c.axis());
    return grains.at(c.id2).x - x + image(c);
  }
  Vector image(const FileContact& c) const {
    Vector shift = Vector::Zero();
    if (c.on_wall()) return shift;
    for (int a = 0; a < 3; ++a) {
      const double side = high[a] - low[a];
      if (!walls[static_cast<std::size_t>(a)])
        shift[a] = -std::round((grains.at(c.id2).x - grains.at(c.id1).x)[a] / side) * side;
    }
    return shift;
  }
  /// Outward force on a wall: the sum of the normal components of the forces of its contacts.
  double wall_force(int axis, int side) const {
    double sum = 0.0;
    for (const FileContact& c : contacts)
      if (c.on_wall() && c.axis() == axis && c.side() == side) sum -= side * c.force[axis];
    return sum;
  }
  std::map<std::int64_t, Vector> net_forces() const {
    std::map<std::int64_t, Vector> net;
    for (const auto& [id, grain] : grains) net[id] = grain.mass * gravity;
    for (const FileContact& c : contacts) {
      net[c.id1] += c.force;
      if (!c.on_wall()) net[c.id2] -= c.force;
    }
    return net;
  }
};

/// Computes the moduli of a packing. The unknowns are the 6 displacements and rotations of each grain, a common shift
/// of the two walls of each axis, and the three strains. Under a strain, the two walls of an axis move along their
/// normals, symmetrically to the middle between them. Walls are stretched with the cell along periodic axes.
class HandModuli {
 public:
  explicit HandModuli(const FilePacking& packing) : packing_(packing) {
    for (const auto& [id, grain] : packing.grains) index_[id] = 6 * static_cast<int>(index_.size());
    n_ = 6 * static_cast<int>(index_.size()) + 3;
    // Contacts of rattlers have no force, and therefore get no stiffness.
    double largest = 0.0;
    for (const FileContact& c : packing.contacts) largest = std::max(largest, c.force.norm());
    for (const FileContact& c : packing.contacts)
      if (c.force.norm() > 1e-8 * largest) add(c);
  }

  Eigen::Matrix3d stiffness() const {
    Eigen::SparseMatrix<double> all(n_ + 3, n_ + 3);
    all.setFromTriplets(entries_.begin(), entries_.end());
    // Some motions have no stiffness: those of rattlers, and shifts of walls without contacts. They get a very small
    // stiffness, which does not change any printed digit of the result.
    Eigen::SparseMatrix<double> inner = all.topLeftCorner(n_, n_);
    for (int k = 0; k < n_; ++k) inner.coeffRef(k, k) += 1e-12 * largest_;
    const Eigen::MatrixXd loads = Eigen::MatrixXd(all.topRightCorner(n_, 3));
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(inner);
    Eigen::MatrixXd u = factor.solve(loads);
    for (int k = 0; k < 3; ++k) u += factor.solve(loads - all.topLeftCorner(n_, n_) * u);
    const Eigen::Matrix3d direct = Eigen::MatrixXd(all.bottomRightCorner(3, 3));
    return (direct - loads.transpose() * u) / packing_.volume();
  }

 private:
  /// Derivatives of the relative displacement at a contact with respect to the unknowns. The key is the index of the
  /// unknown.
  using Row = std::map<int, Vector>;

  static void rotate(int first, const Vector& arm, double sign, Row& row) {
    for (int a = 0; a < 3; ++a) row[first + a] = sign * Vector::Unit(a).cross(arm);
  }
  static void displace(int first, double sign, Row& row) {
    for (int a = 0; a < 3; ++a) row[first + a] = sign * Vector::Unit(a);
  }

  void add(const FileContact& c) {
    const Vector r = packing_.branch(c), normal = r.normalized();
    const int i = index_.at(c.id1), strain = n_;
    Row row;
    displace(i, -1.0, row);
    if (c.on_wall()) {
      rotate(i + 3, r, -1.0, row);
      const int a = c.axis();
      row[n_ - 3 + a] = Vector::Unit(a);
      const double end = (c.side() < 0 ? packing_.low : packing_.high)[a];
      row[strain + a] = (end - 0.5 * (packing_.low[a] + packing_.high[a])) * Vector::Unit(a);
      for (int b = 0; b < 3; ++b)
        if (!packing_.walls[static_cast<std::size_t>(b)])
          row[strain + b] = packing_.grains.at(c.id1).x[b] * Vector::Unit(b);
    } else {
      const int j = index_.at(c.id2);
      const double share = packing_.grains.at(c.id1).radius /
                           (packing_.grains.at(c.id1).radius + packing_.grains.at(c.id2).radius);
      rotate(i + 3, share * r, -1.0, row);
      displace(j, 1.0, row);
      rotate(j + 3, (share - 1.0) * r, 1.0, row);
      const Vector image = packing_.image(c);
      for (int b = 0; b < 3; ++b) row[strain + b] = image[b] * Vector::Unit(b);
    }
    for (const auto& [p, dp] : row)
      for (const auto& [q, dq] : row) {
        const double along = c.kn * normal.dot(dp) * normal.dot(dq);
        const double across = c.kt * (dp.dot(dq) - normal.dot(dp) * normal.dot(dq));
        entries_.emplace_back(p, q, along + across);
      }
    largest_ = std::max(largest_, c.kn);
  }

  const FilePacking& packing_;
  std::map<std::int64_t, int> index_;
  int n_ = 0;
  double largest_ = 0.0;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Converts a file in the same way as `floc convert`.
State<3> converted(const std::string& file, ImportOptions options) {
  const std::string path = kFiles + file;
  const Imported imported = find_import_format("", path).read(path, options);
  auto state = std::get<State<3>>(imported.state);
  complete_import(path, imported, {}, state);
  return state;
}

void expect_as_by_hand(const State<3>& state, const FilePacking& hand) {
  const Packing<3>& p = state.packing;
  ASSERT_EQ(p.grains.size(), 500);
  ASSERT_EQ(p.contacts.size(), hand.contacts.size());
  EXPECT_LT(state.residuals.force, 1e-5);
  const std::vector<double> forces = wall_forces(p);
  double largest = 0.0;
  for (const FileContact& c : hand.contacts) largest = std::max(largest, c.force.norm());
  int n_loaded = 0;
  for (std::size_t w = 0; w < p.walls.size(); ++w) {
    const double by_hand = hand.wall_force(p.walls[w].axis, p.walls[w].side);
    EXPECT_NEAR(forces[w], by_hand, kAgreement * std::max(by_hand, largest)) << w;
    n_loaded += by_hand > 0.0;
  }
  EXPECT_GT(n_loaded, 0);
  const Balance<3> net = net_forces(p);
  const auto of_file = hand.net_forces();
  for (int i = 0; i < 500; ++i)
    EXPECT_NEAR((net.force[i] - of_file.at(p.grains.name(i))).norm(), 0.0, kAgreement * largest) << i;
  const Eigen::Matrix3d C = HandModuli(hand).stiffness();
  const Moduli moduli = elastic_moduli(p, {});
  EXPECT_GT(C.maxCoeff(), 0.0);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(moduli.C(a, b), C(a, b), kAgreement * C.maxCoeff()) << a << b;
}

/// Rows of a dump, and the names of its columns.
struct DumpRows {
  explicit DumpRows(const std::string& file) : rows(rows_behind(file, "ITEM: ATOMS")) {
    std::istringstream in(read_file(kFiles + file));
    std::string line;
    while (!line.starts_with("ITEM: ATOMS")) std::getline(in, line);
    std::istringstream words(line.substr(11));
    for (std::string word; words >> word;) column[word] = column.size();
  }
  double at(const std::vector<double>& row, const std::string& name) const { return row[column.at(name)]; }

  std::vector<std::vector<double>> rows;
  std::map<std::string, std::size_t> column;
};

/// Reads a packing of LAMMPS. `fixes` contains the fix of each wall; the key is the name of the wall as a negative
/// number.
FilePacking lammps_by_hand(const std::string& name, const std::map<std::int64_t, std::string>& fixes) {
  FilePacking packing;
  const DumpRows dump(name + ".dump.gz");
  for (const auto& row : dump.rows) {
    const auto id = static_cast<std::int64_t>(dump.at(row, "id"));
    const Vector x(dump.at(row, "x"), dump.at(row, "y"), dump.at(row, "z"));
    packing.grains[id] = {x, dump.at(row, "radius"), dump.at(row, "mass")};
    for (const auto& [wall, fix] : fixes) {
      const auto number = [&](int k) { return dump.at(row, "f_" + fix + "[" + std::to_string(k) + "]"); };
      FileContact c{id, wall, {number(2), number(3), number(4)}, 1000.0, 800.0};
      if (number(1) == 1.0 && c.side() * c.force[c.axis()] < 0.0) packing.contacts.push_back(c);
    }
  }
  for (const auto& row : rows_behind(name + ".contacts.gz", "ITEM: ENTRIES")) {
    const Vector force(row[2] + row[5], row[3] + row[6], row[4] + row[7]);
    packing.contacts.push_back(
        {static_cast<std::int64_t>(row[0]), static_cast<std::int64_t>(row[1]), force, 1000.0, 800.0});
  }
  return packing;
}

ImportOptions lammps_options(const std::string& name, const std::string& walls) {
  ImportOptions options;
  options.law = parse_law("--law", "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800");
  options.contacts = kFiles + name + ".contacts.gz";
  options.contact_columns = {{"id1", "c_pair[1]"}, {"id2", "c_pair[2]"}};
  for (int a = 1; a <= 3; ++a) {
    options.contact_columns["force" + std::to_string(a)] = "c_force[" + std::to_string(a) + "]";
    options.contact_columns["shear_force" + std::to_string(a)] = "c_force[" + std::to_string(a + 3) + "]";
  }
  options.walls = walls;
  return options;
}

TEST(LammpsWalls, OfABoxGiveForcesBalanceAndModuliByHand) {
  FilePacking hand =
      lammps_by_hand("lammps/box", {{-1, "wx"}, {-2, "wx"}, {-3, "wy1"}, {-4, "wy2"}, {-5, "wz"}, {-6, "wz"}});
  hand.low = Vector::Zero();
  hand.high = Vector(9.6, 9.2, 8.8);
  hand.gravity = Vector::Zero();
  hand.walls = {true, true, true};
  ImportOptions options = lammps_options("lammps/box", kFiles + "lammps/box.in");
  options.columns = {{"x-", "f_wx"},  {"x+", "f_wx"}, {"y-", "f_wy1"},
                     {"y+", "f_wy2"}, {"z-", "f_wz"}, {"z+", "f_wz"}};
  expect_as_by_hand(converted("lammps/box.dump.gz", options), hand);
}

/// Height of the top of the highest grain, which is the upper end of a packing with a free surface.
double top_of(const FilePacking& packing) {
  double top = 0.0;
  for (const auto& [id, grain] : packing.grains) top = std::max(top, grain.x[2] + grain.radius);
  return top;
}

TEST(LammpsWalls, OfAFloorUnderGravityGiveForcesBalanceAndModuliByHand) {
  FilePacking hand = lammps_by_hand("lammps/floor", {{-5, "wz"}});
  hand.low = Vector::Zero();
  hand.high = Vector(8.0, 8.0, top_of(hand));
  hand.gravity = Vector(0.0, 0.0, -0.2);
  hand.walls = {false, false, true};
  ImportOptions options = lammps_options("lammps/floor", kFiles + "lammps/floor.in");
  options.columns = {{"z-", "f_wz"}};
  expect_as_by_hand(converted("lammps/floor.dump.gz", options), hand);
  double weight = 0.0;
  for (const auto& [id, grain] : hand.grains) weight += 0.2 * grain.mass;
  EXPECT_NEAR(hand.wall_force(2, -1), weight, 1e-9 * weight);
}

/// Reads a packing of YADE. The comments in the file contain the walls and the gravity.
FilePacking yade_by_hand(const std::string& name) {
  FilePacking packing;
  packing.walls = {true, true, true};
  for (const auto& row : rows_behind(name + ".txt.gz", ""))
    packing.grains[static_cast<std::int64_t>(row[0])] = {{row[1], row[2], row[3]}, row[4], row[5]};
  for (const auto& row : rows_behind(name + ".interactions.gz", "")) {
    FileContact c{static_cast<std::int64_t>(row[0]), static_cast<std::int64_t>(row[1]),
                  -Vector(row[5] + row[8], row[6] + row[9], row[7] + row[10]), row[11], row[12]};
    if (c.id1 < 0) {  // forces are on the second body
      std::swap(c.id1, c.id2);
      c.force = -c.force;
    }
    packing.contacts.push_back(c);
  }
  return packing;
}

ImportOptions yade_options(const std::string& name) {
  ImportOptions options;
  options.units = "SI";
  options.contacts = kFiles + name + ".interactions.gz";
  return options;
}

TEST(YadeWalls, OfABoxGiveForcesBalanceAndModuliByHand) {
  FilePacking hand = yade_by_hand("yade/box");
  hand.gravity = Vector::Zero();
  const State<3> state = converted("yade/box.txt.gz", yade_options("yade/box"));
  ASSERT_EQ(state.packing.walls.size(), 6u);
  std::istringstream in(read_file(kFiles + "yade/box.txt.gz"));
  for (std::string hash, word, name; in >> hash >> word >> name && word == "wall";)
    in >> (name[1] == '-' ? hand.low : hand.high)[static_cast<Eigen::Index>(std::string("xyz").find(name[0]))];
  expect_as_by_hand(state, hand);
}

TEST(YadeWalls, OfATrayUnderGravityGiveForcesBalanceAndModuliByHand) {
  FilePacking hand = yade_by_hand("yade/floor");
  hand.low = Vector::Zero();
  hand.high = Vector(0.16, 0.16, top_of(hand));
  hand.gravity = Vector(0.0, 0.0, -9.81);
  expect_as_by_hand(converted("yade/floor.txt.gz", yade_options("yade/floor")), hand);
}

}  // namespace
}  // namespace floc::test
