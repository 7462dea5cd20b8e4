#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "floc/network/contact_network.h"

/// Contact networks that are built directly from the numbers in text files. They use neither the readers nor the
/// contact search nor the contact laws of the library.
namespace floc::test {

/// Returns the rows of numbers that follow a line beginning with `header` in a text file. Lines that begin with
/// # are skipped.
inline std::vector<std::vector<double>> numbers_behind(const std::string& path, const std::string& header) {
  std::ifstream in(path);
  std::vector<std::vector<double>> rows;
  bool behind = header.empty();
  for (std::string line; std::getline(in, line);) {
    if (!behind) {
      behind = line.starts_with(header);
      continue;
    }
    if (line.empty() || line[0] == '#') continue;
    std::istringstream tokens(line);
    rows.emplace_back(std::istream_iterator<double>(tokens), std::istream_iterator<double>());
  }
  return rows;
}

/// Position and radius of a grain, read from the row of the grain in a file.
struct HandGrain {
  Eigen::Vector3d x;
  double radius;
};

/// Stiffnesses of a contact, and whether the contact acts across a gap.
struct HandContact {
  double kn, kt;
  bool distant = false;
};

/// Network of pairs of grains in a periodic cell. The rows of the cell matrix are the lattice vectors. The first grain
/// of a pair is connected to the nearest periodic image of the second grain.
template <int Dim>
class HandNetwork {
 public:
  HandNetwork(const Mat<Dim>& cell, const std::map<std::int64_t, HandGrain>& grains)
      : cell_(cell), grains_(grains) {
    network.n_grains = static_cast<int>(grains.size());
    network.volume = std::abs(cell.determinant());
    for (const auto& [id, grain] : grains) {
      index_[id] = static_cast<int>(index_.size());
      network.grain_size.push_back(grain.radius);
    }
  }

  /// Returns the index of the periodic image of the second grain that is nearest to the first grain: one number of
  /// lattice vectors for each axis.
  Vec<Dim, int> nearest_image(std::int64_t id1, std::int64_t id2) const {
    constexpr int kFarthest = 2, kWidth = 2 * kFarthest + 1;
    int n_images = 1;
    for (int a = 0; a < Dim; ++a) n_images *= kWidth;
    Vec<Dim, int> nearest = Vec<Dim, int>::Zero();
    for (int m = 0; m < n_images; ++m) {
      Vec<Dim, int> image;
      for (int a = 0, rest = m; a < Dim; ++a, rest /= kWidth) image[a] = rest % kWidth - kFarthest;
      if (branch(id1, id2, image).norm() < branch(id1, id2, nearest).norm()) nearest = image;
    }
    return nearest;
  }
  /// Returns the vector from the centre of the first grain to the centre of a periodic image of the second grain.
  Vec<Dim> branch(std::int64_t id1, std::int64_t id2, const Vec<Dim, int>& image) const {
    return (grains_.at(id2).x - grains_.at(id1).x).template head<Dim>() +
           cell_.transpose() * image.template cast<double>();
  }
  Vec<Dim> branch(std::int64_t id1, std::int64_t id2) const {
    return branch(id1, id2, nearest_image(id1, id2));
  }
  double gap(std::int64_t id1, std::int64_t id2) const {
    return branch(id1, id2).norm() - grains_.at(id1).radius - grains_.at(id2).radius;
  }
  double reduced_radius(std::int64_t id1, std::int64_t id2) const {
    const double a = grains_.at(id1).radius, b = grains_.at(id2).radius;
    return a * b / (a + b);
  }

  void add(std::int64_t id1, std::int64_t id2, const HandContact& k) {
    const Vec<Dim> r = branch(id1, id2);
    const double share = grains_.at(id1).radius / (grains_.at(id1).radius + grains_.at(id2).radius);
    NetworkContact<Dim> c{};
    c.i = index_.at(id1);
    c.j = index_.at(id2);
    c.branch = r;
    c.arm_i = share * r;
    c.arm_j = (share - 1.0) * r;
    c.frame = contact_frame(Vec<Dim>(r.normalized()));
    c.image = nearest_image(id1, id2);
    c.kn = k.kn;
    c.kt = k.distant ? 0.0 : k.kt;
    c.kr = 0.0;
    c.normal_force = 0.0;
    c.shear_force.setZero();
    c.rolling_moment.setZero();
    c.distant = k.distant;
    c.source = static_cast<int>(network.contacts.size());
    network.contacts.push_back(c);
  }

  ContactNetwork<Dim> network;

 private:
  Mat<Dim> cell_;
  std::map<std::int64_t, HandGrain> grains_;
  std::map<std::int64_t, int> index_;
};

}  // namespace floc::test
