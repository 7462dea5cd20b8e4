#include "floc/structure/phase_structure.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

#include "floc/base/interruption.h"
#include "floc/base/random.h"
#include "floc/network/components.h"

namespace floc {
namespace {

int sign_of(double p) {
  return (p > 0.0 ? 1 : 0) - (p < 0.0 ? 1 : 0);
}

/// Connected parts of one phase. There are two phases: the grains with positive pressure and the grains with negative
/// pressure. A grain without a neighbour in its phase is a part by itself.
template <int Dim>
struct PhaseParts {
  std::vector<int> sizes;
  /// Vectors (length) along which the connected parts wind around the periodic cell.
  std::vector<Vec<Dim>> winding;
  int n_directions = 0;
};

template <int Dim>
PhaseParts<Dim> parts_of(const ContactNetwork<Dim>& network, const Adjacency& of, const std::vector<int>& sign,
                         int phase) {
  std::vector<bool> active;
  active.reserve(network.contacts.size());
  for (const NetworkContact<Dim>& c : network.contacts)
    active.push_back(sign[c.i] == phase && sign[c.j] == phase);
  PhaseParts<Dim> parts;
  std::ptrdiff_t n_single = std::count(sign.begin(), sign.end(), phase);
  for (const Component<Dim>& part : find_components(network, of, active)) {
    parts.sizes.push_back(static_cast<int>(part.grains.size()));
    n_single -= parts.sizes.back();
    parts.winding.insert(parts.winding.end(), part.winding.begin(), part.winding.end());
    parts.n_directions = std::max(parts.n_directions, static_cast<int>(part.winding.size()));
  }
  parts.sizes.insert(parts.sizes.end(), static_cast<std::size_t>(n_single), 1);
  std::sort(parts.sizes.begin(), parts.sizes.end(), std::greater<>());
  return parts;
}

template <int Dim>
void describe(const PhaseParts<Dim>& parts, const Cell<Dim>& cell, PhaseGeometry& phase) {
  phase.cluster_sizes = parts.sizes;
  phase.n_directions = parts.n_directions;
  for (const Vec<Dim>& winding : parts.winding) {
    const Vec<Dim> reduced = cell.reduced(winding);
    for (int a = 0; a < Dim; ++a) phase.along[a] = phase.along[a] || std::abs(reduced[a]) > 0.5;
  }
}

/// Returns the number of bonds between two grains with nonzero pressure and, among these bonds, the number of bonds
/// whose two pressures have equal signs. A bond between a grain and its own image is left out, because the two signs
/// are always equal.
template <int Dim>
std::pair<int, int> like_bonds(const ContactNetwork<Dim>& network, const std::vector<int>& sign) {
  int n = 0, like = 0;
  for (const NetworkContact<Dim>& c : network.contacts) {
    if (c.i == c.j || sign[c.i] == 0 || sign[c.j] == 0) continue;
    ++n;
    like += sign[c.i] == sign[c.j];
  }
  return {n, like};
}

/// Returns the mean magnitude of the pressure of the grains of one phase, as a function of the share of neighbours in
/// the same phase. The grains are sorted into bins of this share. Neighbours with zero pressure are ignored.
template <int Dim>
std::vector<LikeNeighbourBin> by_share(const ContactNetwork<Dim>& network, const Adjacency& of,
                                       const std::vector<int>& sign, const std::vector<double>& pressure,
                                       int phase, int n_bins) {
  std::vector<LikeNeighbourBin> bins(n_bins);
  std::vector<double> squares(n_bins, 0.0);
  for (int b = 0; b < n_bins; ++b)
    bins[b].low = static_cast<double>(b) / n_bins, bins[b].high = (b + 1.0) / n_bins;
  for (int i = 0; i < network.n_grains; ++i) {
    if (sign[i] != phase) continue;
    int n = 0, like = 0;
    for (const int k : of[i]) {
      const NetworkContact<Dim>& c = network.contacts[k];
      const int other = c.i == i ? c.j : c.i;
      if (other == i || sign[other] == 0) continue;
      ++n;
      like += sign[other] == phase;
    }
    if (n == 0) continue;
    // A share exactly on the border between two bins belongs to the upper bin. Integer arithmetic makes this exact.
    const int b = std::min(n_bins - 1, n_bins * like / n);
    ++bins[b].n_grains;
    bins[b].mean_size += std::abs(pressure[i]);
    squares[b] += pressure[i] * pressure[i];
  }
  for (int b = 0; b < n_bins; ++b) {
    LikeNeighbourBin& bin = bins[b];
    if (bin.n_grains == 0) continue;
    bin.mean_size /= bin.n_grains;
    if (bin.n_grains > 1)
      bin.mean_error = std::sqrt(std::max(0.0, squares[b] / bin.n_grains - bin.mean_size * bin.mean_size) /
                                 (bin.n_grains - 1));
  }
  return bins;
}

/// Adds the results for random signs, for comparison with the results for the real signs. The random signs are the real
/// signs, shuffled among the grains with nonzero pressure.
template <int Dim>
void add_control(const ContactNetwork<Dim>& network, const Adjacency& of, std::vector<int> sign,
                 const PhaseOptions& options, PhaseStructure& out) {
  std::vector<int> signed_grains;
  for (int i = 0; i < network.n_grains; ++i)
    if (sign[i] != 0) signed_grains.push_back(i);
  const auto n_plus = static_cast<double>(std::count(sign.begin(), sign.end(), 1));
  const auto n = static_cast<double>(signed_grains.size());
  if (n > 1.0)
    out.like_expected = (n_plus * (n_plus - 1.0) + (n - n_plus) * (n - n_plus - 1.0)) / (n * (n - 1.0));
  constexpr std::uint64_t kPurpose = 0x5151;
  RandomStream random(options.seed, kPurpose);
  double squares = 0.0;
  for (int shuffle = 0; shuffle < options.n_shuffles; ++shuffle) {
    check_interruption();
    for (std::size_t k = signed_grains.size(); k > 1; --k)
      std::swap(sign[signed_grains[k - 1]], sign[signed_grains[random.below(k)]]);
    const auto [n_bonds, like] = like_bonds(network, sign);
    if (n_bonds > 0) squares += std::pow(static_cast<double>(like) / n_bonds - out.like_expected, 2);
    for (auto [phase, value] : {std::pair{&out.positive, 1}, {&out.negative, -1}}) {
      const PhaseParts<Dim> parts = parts_of(network, of, sign, value);
      phase->shuffled_directions += static_cast<double>(parts.n_directions) / options.n_shuffles;
      phase->shuffled_percolates += (parts.n_directions > 0 ? 1.0 : 0.0) / options.n_shuffles;
      if (!parts.sizes.empty())
        phase->largest_shuffled += static_cast<double>(parts.sizes.front()) / options.n_shuffles;
    }
  }
  if (options.n_shuffles > 0) out.like_deviation = std::sqrt(squares / options.n_shuffles);
}

}  // namespace

std::vector<std::string> PhaseOptions::validate() const {
  std::vector<std::string> faults = {range_fault("shuffles", n_shuffles, kShuffles),
                                     range_fault("n_bins", n_bins, kPositiveWhole)};
  std::erase(faults, "");
  return faults;
}

template <int Dim>
PhaseStructure phase_structure(const ContactNetwork<Dim>& network, const Cell<Dim>& cell,
                               const std::vector<double>& pressure, const PhaseOptions& options) {
  assert(static_cast<int>(pressure.size()) == network.n_grains);
  refuse_faults(options.validate());
  const Adjacency of = contacts_of_grains(network);
  std::vector<int> sign;
  sign.reserve(pressure.size());
  for (const double p : pressure) sign.push_back(sign_of(p));
  PhaseStructure out;
  const auto [n_bonds, like] = like_bonds(network, sign);
  out.n_bonds = n_bonds;
  if (n_bonds > 0) out.like_share = static_cast<double>(like) / n_bonds;
  for (auto [phase, value] : {std::pair{&out.positive, 1}, {&out.negative, -1}}) {
    describe(parts_of(network, of, sign, value), cell, *phase);
    phase->by_share = by_share(network, of, sign, pressure, value, options.n_bins);
  }
  add_control(network, of, sign, options, out);
  return out;
}

template PhaseStructure phase_structure(const ContactNetwork<2>&, const Cell<2>&, const std::vector<double>&,
                                        const PhaseOptions&);
template PhaseStructure phase_structure(const ContactNetwork<3>&, const Cell<3>&, const std::vector<double>&,
                                        const PhaseOptions&);

}  // namespace floc
