#include "floc/lattice/irregular_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/base/random.h"
#include "floc/base/range.h"
#include "floc/structure/voronoi_faces.h"

namespace floc {
namespace {

/// Largest number of nodes of a lattice.
constexpr double kMostPoints = 1e8;

/// Number of the random stream from which the displacements of lattice points are drawn.
constexpr std::uint64_t kJitterStream = 0x6c61747469636533;

}  // namespace

std::vector<std::string> IrregularLatticeOptions::validate() const {
  std::vector<std::string> faults;
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    faults.push_back(fmt::format("spacing = {}: must be > 0 and finite", spacing));
  if (!(jitter > 0.0 && jitter < 0.5))
    faults.push_back(fmt::format("jitter = {}: must be between 0 and 0.5", jitter));
  return faults;
}

Lattice<3> irregular_lattice(const Cell<3>& cell, const IrregularLatticeOptions& options) {
  refuse_faults(options.validate());
  if (cell.volume() / std::pow(options.spacing, 3) > kMostPoints)
    throw InputError("",
                     fmt::format("a spacing of {:.3g} is too small: the lattice would have more than 1e8 nodes",
                                 options.spacing));
  Lattice<3> out;
  out.cell = cell;
  Vec<3, int> across;
  for (int a = 0; a < 3; ++a)
    across[a] = std::max(1, static_cast<int>(std::round(cell.matrix.row(a).norm() / options.spacing)));
  out.spacing = std::cbrt(cell.volume() / across.cast<double>().prod());
  RandomStream random(options.seed, kJitterStream);
  for (int z = 0; z < across[2]; ++z)
    for (int y = 0; y < across[1]; ++y)
      for (int x = 0; x < across[0]; ++x) {
        Vec<3> place(x + 0.5, y + 0.5, z + 0.5);
        for (int a = 0; a < 3; ++a) place[a] += random.uniform(-options.jitter, options.jitter);
        out.node.push_back(cell.matrix.transpose() * place.cwiseQuotient(across.cast<double>()));
      }
  const VoronoiFaces faces = voronoi_faces(cell, out.node);
  out.volume = faces.volume;
  out.bonds.reserve(faces.faces.size());
  for (const VoronoiFace& f : faces.faces) out.bonds.push_back({f.i, f.j, f.image, f.branch, f.centre, f.area});
  return out;
}

}  // namespace floc
