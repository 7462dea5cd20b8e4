#include "floc/neighbors/pairs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "floc/base/error.h"
#include "floc/geometry/lattice_reduction.h"

namespace floc {
namespace {

template <int Dim>
bool lexicographically_positive(const Vec<Dim, int>& image) {
  for (int a = 0; a < Dim; ++a)
    if (image[a] != 0) return image[a] > 0;
  return false;
}

/// Beyond it images do not fit an integer.
constexpr double kMostTurns = 1e9;
/// Trials of a search that are fast whatever the packing, and that a grain may take in a large one.
constexpr double kTrialsAlways = 1e8;
constexpr double kTrialsPerGrain = 1e5;
/// Pairs that a packing may have, and more for each of its grains: beyond it, a wrong radius or cell.
constexpr std::size_t kPairsAlways = 10'000;
constexpr std::size_t kPairsPerGrain = 1000;

/// Grains sorted into bins of reduced space, each bin at least the cutoff wide where the cell is large enough.
template <int Dim>
class Bins {
 public:
  Bins(const Cell<Dim>& cell, const Grains<Dim>& grains, double cutoff) {
    const Mat<Dim> to_reduced = cell.matrix.transpose().inverse();
    const double grains_per_side = std::pow(static_cast<double>(std::max(1, grains.size())), 1.0 / Dim);
    for (int a = 0; a < Dim; ++a) {
      const double height = 1.0 / to_reduced.row(a).norm();
      // Bins much finer than the grains cost memory and find nothing.
      count_[a] = static_cast<int>(std::clamp(std::floor(height / cutoff), 1.0, 2.0 * grains_per_side + 1.0));
      reach_[a] = static_cast<int>(std::min(std::ceil(cutoff * count_[a] / height), kMostTurns));
    }
    check_cost(grains.size());
    sort(cell, grains, to_reduced);
  }

  /// Calls visit(j, image of j's bin) for every grain j in reach of grain i's bin.
  template <class Visit>
  void around(int i, const Visit& visit) const {
    Vec<Dim, int> offset = -reach_;
    while (true) {
      visit_bin(i, offset, visit);
      int a = 0;
      while (a < Dim && ++offset[a] > reach_[a]) offset[a] = -reach_[a], ++a;
      if (a == Dim) return;
    }
  }

  const Vec<Dim, int>& wrap(int i) const { return wrap_[i]; }
  const Vec<Dim>& wrapped(int i) const { return wrapped_[i]; }

 private:
  int flat(const Vec<Dim, int>& bin) const {
    int index = bin[0];
    for (int a = 1; a < Dim; ++a) index = index * count_[a] + bin[a];
    return index;
  }

  /// A cell that is tiny beside its grains holds more of their images than could be looked at.
  void check_cost(double n_grains) const {
    const double bins_in_reach = (2.0 * reach_.template cast<double>().array() + 1.0).prod();
    const double trials = n_grains * n_grains * bins_in_reach / count_.template cast<double>().prod();
    if (trials > std::max(kTrialsAlways, kTrialsPerGrain * n_grains))
      throw InputError(
          "cell",
          "is so small beside its largest grain, or the grains are so different in size, that finding "
          "contacts would take " +
              std::to_string(static_cast<std::int64_t>(std::min(trials, 1e18))) + " trials");
  }

  void sort(const Cell<Dim>& cell, const Grains<Dim>& grains, const Mat<Dim>& to_reduced) {
    const int n = grains.size();
    bin_.resize(n);
    wrap_.resize(n);
    wrapped_.resize(n);
    first_.assign(count_.prod() + 1, 0);
    for (int i = 0; i < n; ++i) {
      const Vec<Dim> s = to_reduced * grains.position[i];
      for (int a = 0; a < Dim; ++a) {
        const double turns = std::floor(s[a]);
        if (!(std::abs(turns) < kMostTurns))
          throw InputError("grain " + std::to_string(i), "lies more than 1e9 cells away from the cell");
        wrap_[i][a] = -static_cast<int>(turns);
        bin_[i][a] = std::min(count_[a] - 1, static_cast<int>((s[a] - turns) * count_[a]));
      }
      wrapped_[i] = rounded<Dim>(displaced<Dim>(grains.centre(i), cell, wrap_[i]));
      ++first_[flat(bin_[i]) + 1];
    }
    for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
    member_.resize(n);
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (int i = 0; i < n; ++i) member_[next[flat(bin_[i])]++] = i;
  }

  template <class Visit>
  void visit_bin(int i, const Vec<Dim, int>& offset, const Visit& visit) const {
    Vec<Dim, int> target = bin_[i] + offset;
    Vec<Dim, int> image = Vec<Dim, int>::Zero();
    for (int a = 0; a < Dim; ++a) {  // a few turns at most, and seldom any: dividing took a third of the search
      for (; target[a] < 0; target[a] += count_[a]) --image[a];
      for (; target[a] >= count_[a]; target[a] -= count_[a]) ++image[a];
    }
    const int b = flat(target);
    for (int m = first_[b]; m < first_[b + 1]; ++m) visit(member_[m], image);
  }

  Vec<Dim, int> count_;
  Vec<Dim, int> reach_;
  std::vector<Vec<Dim, int>> bin_;   ///< of each grain
  std::vector<Vec<Dim, int>> wrap_;  ///< image that brings each grain into the cell
  std::vector<Vec<Dim>> wrapped_;    ///< position inside the cell
  std::vector<int> first_;           ///< first member of each bin
  std::vector<int> member_;          ///< grains by bin
};

/// Image of a pair in the lattice it was asked for.
template <int Dim>
Vec<Dim, int> image_in(const ReducedLattice<Dim>& lattice, const Vec<Dim, int>& image) {
  if (lattice.is_original) return image;
  const Vec<Dim, std::int64_t> wide = lattice.original(image);
  if (static_cast<double>(wide.cwiseAbs().maxCoeff()) >= kMostTurns)
    throw InputError("cell", "lattice vectors are so slanted that neighbours are more than 1e9 of them apart");
  return wide.template cast<int>();
}

template <int Dim>
void check_finite(const Cell<Dim>& cell, const Grains<Dim>& grains) {
  if (!cell.matrix.allFinite() || !(cell.volume() > 0.0))
    throw InputError("cell", "lattice vectors must be finite and span a volume");
  for (int i = 0; i < grains.size(); ++i)
    if (!grains.position[i].allFinite() || !std::isfinite(grains.radius[i]))
      throw InputError("grain " + std::to_string(i), "position and radius must be finite");
}

}  // namespace

template <int Dim>
std::vector<NeighborPair<Dim>> find_pairs(const Cell<Dim>& cell, const Grains<Dim>& grains, double gap) {
  check_finite(cell, grains);
  std::vector<NeighborPair<Dim>> pairs;
  if (grains.size() == 0) return pairs;
  const std::size_t most = kPairsAlways + kPairsPerGrain * static_cast<std::size_t>(grains.size());
  const double largest = *std::max_element(grains.radius.begin(), grains.radius.end());
  const ReducedLattice<Dim> lattice = reduced_lattice(cell);
  const Bins<Dim> bins(lattice.cell, grains, 2.0 * largest + gap);

  for (int i = 0; i < grains.size(); ++i) {
    const std::size_t first = pairs.size();
    bins.around(i, [&](int j, const Vec<Dim, int>& image) {
      if (j < i) return;
      const double reach = grains.radius[i] + grains.radius[j] + gap;
      const Vec<Dim> r = bins.wrapped(j) + lattice.cell.shift(image) - bins.wrapped(i);
      if (!(r.squaredNorm() < reach * reach)) return;
      const Vec<Dim, int> original = image_in(lattice, Vec<Dim, int>(image + bins.wrap(j) - bins.wrap(i)));
      if (j == i && !lexicographically_positive<Dim>(original)) return;
      pairs.push_back({i, j, original});
      if (pairs.size() > most)
        throw InputError("cell", "the grains overlap so much, or reach so far, that each has more than " +
                                     std::to_string(kPairsPerGrain) +
                                     " neighbours: a radius or the cell is wrong");
    });
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
              [](const NeighborPair<Dim>& p, const NeighborPair<Dim>& q) {
                if (p.j != q.j) return p.j < q.j;
                return std::lexicographical_compare(p.image.begin(), p.image.end(), q.image.begin(),
                                                    q.image.end());
              });
  }
  return pairs;
}

template std::vector<NeighborPair<2>> find_pairs(const Cell<2>&, const Grains<2>&, double);
template std::vector<NeighborPair<3>> find_pairs(const Cell<3>&, const Grains<3>&, double);

}  // namespace floc
