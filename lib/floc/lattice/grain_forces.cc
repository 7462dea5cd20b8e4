#include "floc/lattice/grain_forces.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

#include "floc/geometry/frame.h"
#include "floc/lattice/bonded_contacts.h"
#include "floc/packing/contact_order.h"

namespace floc {
namespace {

/// Key of a contact: the indices of its two grains, and the periodic image of the second grain.
template <int Dim>
using PairKey = std::array<int, 2 + Dim>;

template <int Dim>
PairKey<Dim> key_of(int i, int j, const Vec<Dim, int>& image) {
  PairKey<Dim> key{i, j};
  std::copy(image.begin(), image.end(), key.begin() + 2);
  return key;
}

/// Forces between two grains of a cemented sample: sums over the lattice elements that join their regions. The region
/// of a grain consists of its own nodes and of the matrix nodes that are nearest to it.
template <int Dim>
struct PairSum {
  Vec<Dim> force = Vec<Dim>::Zero();                         // force on the first grain
  RotationVector<Dim> moment = RotationVector<Dim>::Zero();  // moment on the first grain about its centre
  Mat<Dim> stiffness = Mat<Dim>::Zero();
};

template <int Dim>
class ForceSum {
 public:
  ForceSum(const CementedSample<Dim>& sample, const LatticeNetwork<Dim>& network,
           const LatticeSolution<Dim>& solution)
      : sample_(sample), network_(network), solution_(solution) {}

  std::vector<GrainForce<Dim>> take() {
    for (int e = 0; e < static_cast<int>(network_.elements.size()); ++e) add(e);
    std::vector<GrainForce<Dim>> out;
    for (const auto& [key, sum] : pairs_) out.push_back(force_of(key, sum));
    return out;
  }

 private:
  struct GrainPair {
    int i, j;
    Vec<Dim, int> image;
  };

  Vec<Dim> centre(int grain, const Vec<Dim, int>& image) const {
    return sample_.grains.position[grain] + sample_.lattice.cell.shift(image);
  }

  void add(int e) {
    const LatticeElement<Dim>& element = network_.elements[e];
    int i = sample_.owner[element.i], j = sample_.owner[element.j];
    const Vec<Dim, int> image_i = sample_.owner_image[element.i];
    Vec<Dim, int> image = sample_.owner_image[element.j] + element.image - image_i;
    if (i == j && image.isZero()) return;
    Vec<Dim> on_first = solution_.force_on_i(network_, e);
    Vec<Dim> at = sample_.lattice.node[element.i] + element.arm_i - centre(i, image_i);
    RotationVector<Dim> bending = RotationVector<Dim>::Zero();
    if (!solution_.moment.empty()) bending = solution_.moment[e];
    if (!is_canonical(GrainPair{i, j, image})) {
      at -= centre(j, image) - centre(i, Vec<Dim, int>::Zero());
      std::swap(i, j);
      image = -image;
      on_first = -on_first;
      bending = -bending;
    }
    PairSum<Dim>& sum = pairs_[key_of<Dim>(i, j, image)];
    sum.force += on_first;
    sum.moment += moment<double>(at, on_first) + bending;
    if (solution_.open[e]) return;
    const Vec<Dim> n = element.branch.normalized();
    sum.stiffness += element.kn * n * n.transpose();
    if (!element.unilateral)
      sum.stiffness += network_.shear * element.kn * (Mat<Dim>::Identity() - n * n.transpose());
  }

  GrainForce<Dim> force_of(const PairKey<Dim>& key, const PairSum<Dim>& sum) const {
    GrainForce<Dim> out;
    out.i = key[0], out.j = key[1];
    std::copy(key.begin() + 2, key.end(), out.image.begin());
    out.branch = centre(out.j, out.image) - centre(out.i, Vec<Dim, int>::Zero());
    const Vec<Dim> n = out.branch.normalized();
    out.normal = -n.dot(sum.force);
    out.shear = sum.force + out.normal * n;
    const double ri = sample_.grains.radius[out.i], rj = sample_.grains.radius[out.j];
    out.moment = sum.moment - moment<double>(Vec<Dim>(ri / (ri + rj) * out.branch), sum.force);
    out.kn = n.dot(sum.stiffness * n);
    out.kt = (sum.stiffness.trace() - out.kn) / (Dim - 1);
    return out;
  }

  const CementedSample<Dim>& sample_;
  const LatticeNetwork<Dim>& network_;
  const LatticeSolution<Dim>& solution_;
  std::map<PairKey<Dim>, PairSum<Dim>> pairs_;
};

}  // namespace

template <int Dim>
std::vector<GrainForce<Dim>> grain_forces(const CementedSample<Dim>& sample, const LatticeNetwork<Dim>& network,
                                          const LatticeSolution<Dim>& solution) {
  return ForceSum<Dim>(sample, network, solution).take();
}

template <int Dim>
Packing<Dim> packing_of(const CementedSample<Dim>& sample, const Packing<Dim>& packing,
                        const std::vector<GrainForce<Dim>>& forces) {
  Packing<Dim> out;
  out.cell = sample.lattice.cell;
  out.grains = sample.grains;
  out.grains.mass = packing.grains.mass;
  // Rolling stiffness of a contact: K_N width^2/12, where K_N is the normal stiffness. The contact is assumed to be as
  // wide as the bridge between its grains.
  const double width = std::max(sample.bridge_width * 0.5 * sample.mean_diameter, sample.lattice.spacing);
  BondedContacts<Dim> bonds;
  for (const GrainForce<Dim>& f : forces)
    bonds.push_back(
        {f.i, f.j, f.image, f.normal, f.shear, f.moment, f.kn, f.kt, f.kn * width * width / 12.0, Dim == 3});
  set_bonded_contacts(bonds, out);
  return out;
}

template <int Dim>
std::vector<Contact<Dim>> contacts_in_images_of(const CementedSample<Dim>& sample, const Packing<Dim>& other) {
  const Grains<Dim>& here = sample.grains;
  const Grains<Dim>& there = other.grains;
  assert(here.size() == there.size());
  std::vector<Contact<Dim>> out;
  for (Contact<Dim> c : other.contacts) {
    if (c.i < 0 || c.j < 0 || c.i >= here.size() || c.j >= here.size()) continue;  // contacts with walls
    const Vec<Dim> branch_there =
        other.cell.reduced(there.position[c.j] - there.position[c.i]) + c.image.template cast<double>();
    const Vec<Dim> without_image = sample.lattice.cell.reduced(here.position[c.j] - here.position[c.i]);
    for (int a = 0; a < Dim; ++a)
      c.image[a] = static_cast<int>(std::lround(branch_there[a] - without_image[a]));
    out.push_back(canonical(std::move(c)));
  }
  return out;
}

template <int Dim>
ForceAgreement agreement(const std::vector<GrainForce<Dim>>& forces, const std::vector<Contact<Dim>>& contacts,
                         const std::vector<double>& normal_force) {
  assert(contacts.size() == normal_force.size());
  std::map<PairKey<Dim>, double> here;
  for (const GrainForce<Dim>& f : forces) here[key_of<Dim>(f.i, f.j, f.image)] = f.normal;
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto found = here.find(key_of<Dim>(contacts[c].i, contacts[c].j, contacts[c].image));
    if (found == here.end()) continue;
    const double a = found->second, b = normal_force[c];
    n += 1.0, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
  }
  ForceAgreement out;
  out.n_common = static_cast<int>(n);
  const double product = (xx - x * x / n) * (yy - y * y / n);
  if (n >= 3.0 && product > 0.0) out.pearson = (xy - x * y / n) / std::sqrt(product);
  return out;
}

#define FLOC_INSTANTIATE(Dim)                                                                                \
  template std::vector<GrainForce<Dim>> grain_forces(const CementedSample<Dim>&, const LatticeNetwork<Dim>&, \
                                                     const LatticeSolution<Dim>&);                           \
  template Packing<Dim> packing_of(const CementedSample<Dim>&, const Packing<Dim>&,                          \
                                   const std::vector<GrainForce<Dim>>&);                                     \
  template std::vector<Contact<Dim>> contacts_in_images_of(const CementedSample<Dim>&, const Packing<Dim>&); \
  template ForceAgreement agreement(const std::vector<GrainForce<Dim>>&, const std::vector<Contact<Dim>>&,   \
                                    const std::vector<double>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
