#include "floc/lattice/phase_bounds.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace floc {
namespace {

/// Shares of the volume up to this number are rounding errors of sums of volumes. The share of a single node is larger.
constexpr double kNoShare = 1e-10;

/// Returns the mean modulus [sum of share/(modulus + y)]^-1 - y over the phases of a composite. For y = 0 it is the
/// harmonic mean. For the bounds of Hashin and Shtrikman, y depends on the reference phase; see bulk_reference() and
/// shear_reference().
double mean_with(const std::vector<ElasticPhase>& phases, double ElasticPhase::*modulus, double y) {
  double sum = 0.0;
  for (const ElasticPhase& p : phases) {
    if (p.*modulus + y == 0.0) return 0.0;
    sum += p.share / (p.*modulus + y);
  }
  return sum > 0.0 ? 1.0 / sum - y : 0.0;
}

/// Returns the value of y in mean_with() for the bounds of Hashin and Shtrikman on the bulk modulus: 2 G (d - 1)/d in
/// dimension d, with the shear modulus G of the reference phase.
double bulk_reference(double G, int dimension) {
  return 2.0 * G * (dimension - 1) / dimension;
}

/// Returns the value of y in mean_with() for the bounds of Hashin and Shtrikman on the shear modulus: K G/(K + 2 G) in
/// 2D, G (9 K + 8 G)/(6 (K + 2 G)) in 3D, with the moduli K and G of the reference phase.
double shear_reference(double K, double G, int dimension) {
  if (K + 2.0 * G == 0.0) return 0.0;
  return dimension == 2 ? K * G / (K + 2.0 * G) : G * (9.0 * K + 8.0 * G) / (6.0 * (K + 2.0 * G));
}

ModulusBounds bounds_of(const std::vector<ElasticPhase>& phases, double ElasticPhase::*modulus, double least,
                        double most) {
  double voigt = 0.0;
  for (const ElasticPhase& p : phases) voigt += p.share * p.*modulus;
  return {voigt, mean_with(phases, modulus, most), mean_with(phases, modulus, least),
          mean_with(phases, modulus, 0.0)};
}

}  // namespace

CompositeBounds composite_bounds(const std::vector<ElasticPhase>& all, int dimension) {
  std::vector<ElasticPhase> phases;
  for (const ElasticPhase& p : all)
    if (p.share > kNoShare) phases.push_back(p);
  double least_K = -1.0, most_K = 0.0, least_G = 0.0, most_G = 0.0;
  for (const ElasticPhase& p : phases) {
    const bool first = least_K < 0.0;
    least_K = first ? p.K : std::min(least_K, p.K);
    least_G = first ? p.G : std::min(least_G, p.G);
    most_K = std::max(most_K, p.K);
    most_G = std::max(most_G, p.G);
  }
  assert(least_K >= 0.0);
  return {bounds_of(phases, &ElasticPhase::K, bulk_reference(least_G, dimension),
                    bulk_reference(most_G, dimension)),
          bounds_of(phases, &ElasticPhase::G, shear_reference(least_K, least_G, dimension),
                    shear_reference(most_K, most_G, dimension))};
}

template <int Dim>
BoundsThatHold bounds_that_hold(const LatticeNetwork<Dim>& network, const ElementStiffness& stiffness,
                                int n_open) {
  BoundsThatHold out;
  const auto compare = [&out](double actual, double bonded) {
    if (actual > bonded) out.upper = false;
    if (actual < bonded) out.lower = false;
  };
  ElementStiffness bonded;
  bonded.grain = stiffness.grain;
  bonded.matrix = stiffness.matrix;
  // Elements without stiffness are not in the network, so that their number does not say whether there are interfaces.
  const double interface = stiffness.of(ElementKind::interface), contact = stiffness.of(ElementKind::bare);
  if (interface == 0.0 || network.count(ElementKind::interface) > 0)
    compare(interface, bonded.of(ElementKind::interface));
  if (contact == 0.0 || network.count(ElementKind::bare) > 0) compare(contact, bonded.of(ElementKind::bare));
  const bool incomplete = stiffness.contact == BareContact::none || stiffness.patch.has_value();
  // A unilateral contact resists no shear, even if it is closed.
  const bool smooth = stiffness.contact == BareContact::unilateral && stiffness.shear > 0.0 &&
                      network.count(ElementKind::bare) > 0;
  if (incomplete || smooth || n_open > 0) out.lower = false;
  return out;
}

template BoundsThatHold bounds_that_hold(const LatticeNetwork<2>&, const ElementStiffness&, int);
template BoundsThatHold bounds_that_hold(const LatticeNetwork<3>&, const ElementStiffness&, int);

ElasticPhase triangular_moduli(double share, double kn, double kt) {
  return {share, 0.5 * std::numbers::sqrt3 * kn, 0.25 * std::numbers::sqrt3 * (kn + kt)};
}

}  // namespace floc
