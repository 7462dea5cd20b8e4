#include "floc/io/lammps_box.h"

#include <fmt/format.h>

#include "floc/base/error.h"

namespace floc {

void LammpsBox::set_general(int index, const Eigen::Vector3d& vector) {
  if (!general) general = Eigen::Matrix3d::Zero();
  general->row(index) = vector.transpose();
}

Eigen::Matrix3d LammpsBox::matrix() const {
  if (general) return *general;
  Eigen::Matrix3d m;
  m << side[0], 0.0, 0.0, xy, side[1], 0.0, xz, yz, side[2];
  return m;
}

std::vector<std::vector<double>> LammpsBox::vectors() const {
  const Eigen::Matrix3d rows = matrix();
  std::vector<std::vector<double>> vectors(3);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) vectors[a].push_back(rows(a, b));
  return vectors;
}

}  // namespace floc
