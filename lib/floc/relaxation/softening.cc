#include "floc/relaxation/softening.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "floc/contact/history.h"
#include "floc/contact/softened_law.h"
#include "floc/packing/law/contact_forces.h"

namespace floc {
namespace {

/// Weight of relative displacements perpendicular to the normal of a contact, divided by the weight of those along the
/// normal. The weights multiply the squared relative displacements of the two grains.
constexpr double kAcross = 1e-4;
/// Relative accuracy of the computed displacements of the grains.
constexpr double kGapAccuracy = 1e-4;
/// Largest number of iterations for the displacements of the grains.
constexpr int kMostIterations = 5000;

/// Multiplies the numbers in the histories of all contacts by factors that depend on the units of the numbers.
template <int Dim, class FactorOfUnit>
void multiply_histories(Packing<Dim>& packing, const Law& law, const FactorOfUnit& factor) {
  for (const HistoryQuantity& q : history_quantities(law, Dim))
    for (Contact<Dim>& c : packing.contacts) c.history.segment(q.begin, q.size) *= factor(q.declared.unit);
}

/// Condition on the displacements of the two grains of a contact: the gap changes by a given length.
template <int Dim>
struct GapChange {
  int i, j;
  Vec<Dim> normal, branch;
  double weight;  ///< weight of the squared error of the gap: stiffness of the contact (force/length)
  double change;  ///< required change of the gap (length)
};

/// Displacements of the grains, and strain of the cell along each axis.
template <int Dim>
struct Displacement {
  std::vector<Vec<Dim>> grain;
  Vec<Dim> strain = Vec<Dim>::Zero();

  double dot(const Displacement& other) const {
    double sum = strain.dot(other.strain);
    for (std::size_t i = 0; i < grain.size(); ++i) sum += grain[i].dot(other.grain[i]);
    return sum;
  }
  void add(double factor, const Displacement& other) {
    strain += factor * other.strain;
    for (std::size_t i = 0; i < grain.size(); ++i) grain[i] += factor * other.grain[i];
  }
};

/// Least squares problem for the displacements that change the gaps of all contacts by required lengths. Among all
/// displacements with this effect, the solution has the smallest relative displacements perpendicular to the normals
/// (weight kAcross).
template <int Dim>
class GapChanges {
 public:
  GapChanges(const Packing<Dim>& packing, double growth) : n_grains_(packing.grains.size()) {
    for (const Contact<Dim>& c : packing.contacts) {
      const double r = packing.grains.radius[c.i] + packing.grains.radius[c.j] + c.gap;
      const double change = c.distant ? 0.0 : (growth - 1.0) * c.gap;
      changes_.push_back({c.i, c.j, c.normal, r * c.normal, std::abs(c.kn), change});
    }
  }

  /// Solves the problem by conjugate gradients, preconditioned with the diagonal of the matrix.
  Displacement<Dim> solve() const {
    Displacement<Dim> x = zero(), residual = zero();
    for (const GapChange<Dim>& g : changes_) apply(g, g.weight * g.change * g.normal, residual);
    const Displacement<Dim> inverse = inverse_diagonal();
    Displacement<Dim> z = scaled(residual, inverse), p = z;
    double gain = residual.dot(z);
    const double enough = kGapAccuracy * kGapAccuracy * gain;
    for (int k = 0; k < kMostIterations && gain > enough; ++k) {
      const Displacement<Dim> q = product(p);
      const double step = gain / p.dot(q);
      x.add(step, p);
      residual.add(-step, q);
      z = scaled(residual, inverse);
      const double next = residual.dot(z);
      const double ratio = next / gain;
      gain = next;
      z.add(ratio, p);
      std::swap(p, z);
    }
    return x;
  }

 private:
  Displacement<Dim> zero() const {
    return {std::vector<Vec<Dim>>(static_cast<std::size_t>(n_grains_), Vec<Dim>::Zero())};
  }
  static void apply(const GapChange<Dim>& g, const Vec<Dim>& force, Displacement<Dim>& to) {
    to.grain[g.j] += force;
    to.grain[g.i] -= force;
    to.strain += force.cwiseProduct(g.branch);
  }
  Displacement<Dim> product(const Displacement<Dim>& p) const {
    Displacement<Dim> out = zero();
    for (const GapChange<Dim>& g : changes_) {
      const Vec<Dim> d = p.grain[g.j] - p.grain[g.i] + p.strain.cwiseProduct(g.branch);
      apply(g, g.weight * (kAcross * d + (1.0 - kAcross) * g.normal.dot(d) * g.normal), out);
    }
    return out;
  }
  Displacement<Dim> inverse_diagonal() const {
    Displacement<Dim> diagonal = zero();
    for (const GapChange<Dim>& g : changes_) {
      const Vec<Dim> own =
          g.weight * (Vec<Dim>::Constant(kAcross) + (1.0 - kAcross) * g.normal.cwiseProduct(g.normal));
      diagonal.grain[g.i] += own;
      diagonal.grain[g.j] += own;
      diagonal.strain += own.cwiseProduct(g.branch.cwiseProduct(g.branch));
    }
    const auto invert = [](Vec<Dim>& v) { v = v.unaryExpr([](double d) { return d > 0.0 ? 1.0 / d : 0.0; }); };
    for (Vec<Dim>& v : diagonal.grain) invert(v);
    invert(diagonal.strain);
    return diagonal;
  }
  static Displacement<Dim> scaled(const Displacement<Dim>& v, const Displacement<Dim>& by) {
    Displacement<Dim> out = v;
    out.strain = v.strain.cwiseProduct(by.strain);
    for (std::size_t i = 0; i < v.grain.size(); ++i) out.grain[i] = v.grain[i].cwiseProduct(by.grain[i]);
    return out;
  }

  int n_grains_;
  std::vector<GapChange<Dim>> changes_;
};

template <int Dim>
void displace(const Displacement<Dim>& by, Packing<Dim>& packing) {
  const Vec<Dim> stretch = Vec<Dim>::Ones() + by.strain;
  packing.cell.matrix = packing.cell.matrix * stretch.asDiagonal();
  packing.grains.position_low.clear();
  for (int i = 0; i < packing.grains.size(); ++i) {
    Vec<Dim>& x = packing.grains.position[i];
    x = x.cwiseProduct(stretch) + by.grain[i];
  }
}

}  // namespace

template <int Dim>
void soften_in_place(Packing<Dim>& packing, const Law& law, double from, double to) {
  if (from == to) return;
  packing.law = to == 1.0 ? law : softened(law, to);
  // Elongations do not change. History variables that are forces or stiffnesses change in proportion to the stiffness
  // of the springs.
  multiply_histories(packing, law, [&](Unit unit) {
    return unit == Unit::force || unit == Unit::stiffness ? from / to : 1.0;
  });
  refresh_contacts(packing);
}

template <int Dim>
void change_softening(Packing<Dim>& packing, const Law& law, double from, double to) {
  const Displacement<Dim> displacement =
      GapChanges<Dim>(packing, std::pow(to / from, 1.0 / law.force_exponent())).solve();
  packing.law = to == 1.0 ? law : softened(law, to);
  // Friction models with a force as history also store the stiffness at the last update. This stiffness is set to zero,
  // so that the next update does not change the force (MindlinFriction::set_force()).
  multiply_histories(packing, law, [&](Unit unit) {
    return unit == Unit::length || unit == Unit::angle ? to / from : unit == Unit::stiffness ? 0.0 : 1.0;
  });
  displace(displacement, packing);
  refresh_contacts(packing);
}

#define FLOC_INSTANTIATE(Dim)                                               \
  template void soften_in_place(Packing<Dim>&, const Law&, double, double); \
  template void change_softening(Packing<Dim>&, const Law&, double, double);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
