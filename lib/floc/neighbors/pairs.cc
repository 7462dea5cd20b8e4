#include "floc/neighbors/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

#include "floc/base/error.h"
#include "floc/geometry/lattice_reduction.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Largest accepted distance between a grain and the cell, in numbers of lattice vectors. Much larger numbers could
/// overflow an int.
constexpr double kMaxCells = 1e9;
/// A search among n grains may test the distances of at most kTrialsAlways pairs or n * kTrialsPerGrain pairs,
/// whichever is larger.
constexpr double kTrialsAlways = 1e8;
constexpr double kTrialsPerGrain = 1e5;
/// A search among n grains may find at most kPairsAlways pairs more than the caller expects.
constexpr double kPairsAlways = 1e4;
/// Largest number of size levels into which grains are sorted. Each level contains grains whose sizes differ by at most
/// a factor of two, except that the last level contains all smaller grains, too.
constexpr int kMaxLevels = 32;

/// Positions of the grains of a packing after each grain was moved into the cell by lattice vectors.
template <int Dim>
struct WrappedGrains {
  /// Reduced coordinates of each grain (in lattice vectors), inside [0, 1] up to rounding.
  std::vector<Vec<Dim>> reduced;
  /// For each grain, the number of times that each lattice vector is added to move the grain into the cell.
  std::vector<Vec<Dim, int>> wrap;
  std::vector<Vec<Dim>> position;

  WrappedGrains(const Cell<Dim>& cell, const Grains<Dim>& grains)
      : reduced(grains.size()), wrap(grains.size()), position(grains.size()) {
    const Mat<Dim> to_reduced = cell.matrix.transpose().inverse();
    for (int i = 0; i < grains.size(); ++i) {
      const Vec<Dim> s = to_reduced * grains.position[i];
      for (int a = 0; a < Dim; ++a) {
        const double cells = std::floor(s[a]);
        if (!(std::abs(cells) < kMaxCells))
          throw InputError("grain " + std::to_string(grains.name(i)),
                           "the grain lies more than 1e9 cells away from the cell");
        wrap[i][a] = -static_cast<int>(cells);
        reduced[i][a] = s[a] - cells;
      }
      position[i] = rounded<Dim>(displaced<Dim>(grains.centre(i), cell, wrap[i]));
    }
  }
};

/// Bins (parallelepipeds) into which the cell is divided, and the grains in each bin. Each lattice vector is divided
/// into equal parts. Each bin is at least as wide as the cutoff distance, unless the cell is narrower.
template <int Dim>
class Bins {
 public:
  /// @param grains  positions of all grains, moved into the cell
  /// @param members  indices of the grains that are sorted into bins: one or more, in ascending order
  /// @param cutoff  smallest width (length) of a bin; if the cell is narrower, a bin is as wide as the cell
  Bins(const Cell<Dim>& cell, const WrappedGrains<Dim>& grains, const std::vector<int>& members, double cutoff)
      : grains_(grains) {
    const Mat<Dim> to_reduced = cell.matrix.transpose().inverse();
    const double grains_per_side = std::pow(static_cast<double>(members.size()), 1.0 / Dim);
    for (int a = 0; a < Dim; ++a) {
      height_[a] = 1.0 / to_reduced.row(a).norm();
      // Bins much smaller than the spacing of the grains would use memory without saving time.
      count_[a] =
          static_cast<int>(std::clamp(std::floor(height_[a] / cutoff), 1.0, 2.0 * grains_per_side + 1.0));
    }
    sort(members);
  }

  /// Returns an upper bound of the number of bins that around() visits for one grain.
  /// @param reach  argument `reach` of around() (length)
  double bins_within(double reach) const {
    double bins = 1.0;
    for (int a = 0; a < Dim; ++a) bins *= 2.0 * std::ceil(reach * count_[a] / height_[a]) + 1.0;
    return bins;
  }
  double bins() const { return count_.template cast<double>().prod(); }

  /// Calls visit(j, image) for every grain j of these bins whose centre may be closer than `reach` (length) to the
  /// centre of grain i. `image` is the periodic image of grain j whose centre may be this close, in numbers of lattice
  /// vectors.
  template <class Visit>
  void around(int i, double reach, const Visit& visit) const {
    const Window window = window_around(i, reach);
    for_each_bin(window.first, window, [&](const Vec<Dim, int>& bin) { visit_bin(bin, visit); });
  }

  /// Calls visit(j, image) like around(), but leaves out two groups of grains: those in the bins that around() visits
  /// before the bin of i, and those in the bin of i with an index below i. If the function is called for all grains in
  /// these bins, it visits each pair once. Grain i must be in these bins.
  template <class Visit>
  void around_and_after(int i, double reach, const Visit& visit) const {
    const Window window = window_around(i, reach);
    const Vec<Dim, int> own = bin_of(i);
    for_each_bin(own, window, [&](const Vec<Dim, int>& bin) {
      if (bin == own)
        visit_bin(bin, [&](int j, const Vec<Dim, int>& image) {
          if (j >= i) visit(j, image);
        });
      else
        visit_bin(bin, visit);
    });
  }

 private:
  struct Window {
    Vec<Dim, int> first, last;
  };

  Window window_around(int i, double reach) const {
    Window window;
    for (int a = 0; a < Dim; ++a) {
      const double s = grains_.reduced[i][a] * count_[a];
      // The window (range of bins to visit) is widened by a billionth of a bin on each side, so that rounding errors
      // cannot hide a pair.
      const double bins = std::min(reach / height_[a] * count_[a], kMaxCells) + 1e-9;
      window.first[a] = static_cast<int>(std::floor(s - bins));
      window.last[a] = static_cast<int>(std::floor(s + bins));
    }
    return window;
  }

  /// Calls visit(bin) for each bin of a window (a box of bins around a grain). The first bin is `begin`, and the index
  /// along the first axis changes fastest.
  template <class Visit>
  static void for_each_bin(const Vec<Dim, int>& begin, const Window& window, const Visit& visit) {
    Vec<Dim, int> bin = begin;
    while (true) {
      visit(bin);
      int a = 0;
      while (a < Dim && ++bin[a] > window.last[a]) bin[a] = window.first[a], ++a;
      if (a == Dim) return;
    }
  }

  int flat(const Vec<Dim, int>& bin) const {
    int index = bin[0];
    for (int a = 1; a < Dim; ++a) index = index * count_[a] + bin[a];
    return index;
  }

  Vec<Dim, int> bin_of(int i) const {
    Vec<Dim, int> bin;
    for (int a = 0; a < Dim; ++a)
      bin[a] = std::min(count_[a] - 1, static_cast<int>(grains_.reduced[i][a] * count_[a]));
    return bin;
  }

  void sort(const std::vector<int>& members) {
    std::vector<int> bin(members.size());
    first_.assign(count_.prod() + 1, 0);
    for (std::size_t m = 0; m < members.size(); ++m) ++first_[(bin[m] = flat(bin_of(members[m]))) + 1];
    for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
    member_.resize(members.size());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t m = 0; m < members.size(); ++m) member_[next[bin[m]]++] = members[m];
  }

  template <class Visit>
  void visit_bin(Vec<Dim, int> target, const Visit& visit) const {
    Vec<Dim, int> image = Vec<Dim, int>::Zero();
    // These loops move the bin `target` back into the cell. The loops are faster than divisions, because the bin is at
    // most a few cells outside; divisions took a third of the computing time of the search.
    for (int a = 0; a < Dim; ++a) {
      for (; target[a] < 0; target[a] += count_[a]) --image[a];
      for (; target[a] >= count_[a]; target[a] -= count_[a]) ++image[a];
    }
    const int b = flat(target);
    for (int m = first_[b]; m < first_[b + 1]; ++m) visit(member_[m], image);
  }

  const WrappedGrains<Dim>& grains_;
  Vec<Dim> height_;  ///< for each lattice vector, distance between the opposite faces of the cell (length)
  Vec<Dim, int> count_;
  /// For each bin, the index in member_ of the first grain of the bin; the last entry is the size of member_.
  std::vector<int> first_;
  std::vector<int> member_;  ///< indices of the grains in these bins, sorted by bin
};

/// Size level: grains of similar radius. The bins are wide enough for the largest of these grains.
template <int Dim>
struct SizeLevel {
  std::vector<int> members;
  double largest;  ///< radius of the largest grain of this level (length)
  Bins<Dim> bins;
};

/// Sorts the grains into levels of similar size, the level of the largest grains first. A grain of radius R needs bins
/// of width 2 R + gap. If the largest width is at most kSimilarSizes times the smallest, all grains form one level. If
/// not, there is one level per factor of two in width. Levels save time. Without levels, all bins would be as wide as
/// the largest grain, and each small grain would be compared with all small grains in several of these wide bins
/// (Ogarko and Luding, Comput. Phys. Commun. 183, 931, 2012).
template <int Dim>
std::vector<SizeLevel<Dim>> size_levels(const Cell<Dim>& cell, const Grains<Dim>& grains,
                                        const WrappedGrains<Dim>& wrapped, double gap) {
  const auto [least, most] = std::minmax_element(grains.radius.begin(), grains.radius.end());
  // Half widths are compared. The width itself could overflow if a radius is close to the largest double.
  const double widest = *most + 0.5 * gap;
  const bool one = widest <= kSimilarSizes * (*least + 0.5 * gap);
  std::vector<std::vector<int>> members(kMaxLevels);
  for (int i = 0; i < grains.size(); ++i) {
    const double width = std::max(0.0, grains.radius[i] + 0.5 * gap);
    members[one ? 0 : std::clamp(std::ilogb(widest / width), 0, kMaxLevels - 1)].push_back(i);
  }
  std::vector<SizeLevel<Dim>> levels;
  for (std::vector<int>& of_level : members) {
    if (of_level.empty()) continue;
    double largest = grains.radius[of_level.front()];
    for (const int i : of_level) largest = std::max(largest, grains.radius[i]);
    Bins<Dim> bins(cell, wrapped, of_level, 2.0 * largest + gap);
    levels.push_back({std::move(of_level), largest, std::move(bins)});
  }
  return levels;
}

/// Throws an InputError if a search would test too many pairs of grains: if the cell is so small that each grain has
/// many periodic images nearby, or if the grains differ too much in size.
template <int Dim>
void check_cost(const std::vector<SizeLevel<Dim>>& levels, double n_grains, double gap) {
  double trials = 0.0;
  for (std::size_t fine = 0; fine < levels.size(); ++fine)
    for (std::size_t coarse = 0; coarse <= fine; ++coarse) {
      const Bins<Dim>& bins = levels[coarse].bins;
      trials += static_cast<double>(levels[fine].members.size()) *
                static_cast<double>(levels[coarse].members.size()) *
                bins.bins_within(levels[fine].largest + levels[coarse].largest + gap) / bins.bins();
    }
  if (trials > std::max(kTrialsAlways, kTrialsPerGrain * n_grains))
    throw InputError(
        "cell",
        "the cell is so small compared with its largest grain, or the grains differ so much in size, that the "
        "search for contacts would have to test " +
            std::to_string(static_cast<std::int64_t>(std::min(trials, 1e18))) +
            " pairs of grains: check the lattice vectors and the radii");
}

/// Converts the periodic image of the second grain of a pair to lattice vectors of the packing. The search gives the
/// image in vectors of the reduced lattice.
template <int Dim>
Vec<Dim, int> image_in(const ReducedLattice<Dim>& lattice, const Vec<Dim, int>& image) {
  if (lattice.is_original) return image;
  const Vec<Dim, std::int64_t> wide = lattice.original(image);
  if (static_cast<double>(wide.cwiseAbs().maxCoeff()) >= kMaxCells)
    throw InputError(
        "cell",
        "the lattice vectors are so oblique that neighbouring grains are more than 1e9 lattice vectors apart");
  return wide.template cast<int>();
}

template <int Dim>
void check_finite(const Cell<Dim>& cell, const Grains<Dim>& grains) {
  if (!cell.matrix.allFinite() || !(cell.volume() > 0.0))
    throw InputError("cell", "the lattice vectors must be finite and span a volume");
  for (int i = 0; i < grains.size(); ++i)
    if (!grains.position[i].allFinite() || !std::isfinite(grains.radius[i]))
      throw InputError("grain " + std::to_string(grains.name(i)),
                       "the position and the radius of the grain must be finite");
}

/// Search for all pairs of close grains of a packing. Each grain is compared with the grains of its own size level, and
/// with the grains of levels with larger grains.
template <int Dim>
class PairSearch {
 public:
  PairSearch(const Cell<Dim>& cell, const Grains<Dim>& grains, double gap, double most_per_grain)
      : grains_(grains),
        gap_(gap),
        most_per_grain_(most_per_grain),
        lattice_(reduced_lattice(cell)),
        wrapped_(lattice_.cell, grains) {}

  /// Returns all pairs of grains whose surfaces are closer than gap_, in no particular order.
  std::vector<NeighborPair<Dim>> all() {
    const std::vector<SizeLevel<Dim>> levels = size_levels(lattice_.cell, grains_, wrapped_, gap_);
    check_cost(levels, grains_.size(), gap_);
    for (std::size_t fine = 0; fine < levels.size(); ++fine)
      for (const int i : levels[fine].members) {
        const auto visit = [&](int j, const Vec<Dim, int>& image) { try_pair(i, j, image); };
        levels[fine].bins.around_and_after(i, grains_.radius[i] + levels[fine].largest + gap_, visit);
        for (std::size_t coarse = 0; coarse < fine; ++coarse)
          levels[coarse].bins.around(i, grains_.radius[i] + levels[coarse].largest + gap_, visit);
      }
    return std::move(pairs_);
  }

 private:
  void try_pair(int i, int j, const Vec<Dim, int>& image) {
    const double reach = grains_.radius[i] + grains_.radius[j] + gap_;
    Vec<Dim> r = wrapped_.position[j];
    if (!image.isZero()) r += lattice_.cell.shift(image);
    r -= wrapped_.position[i];
    if (!(r.squaredNorm() < reach * reach)) return;
    NeighborPair<Dim> pair{i, j,
                           image_in(lattice_, Vec<Dim, int>(image + wrapped_.wrap[j] - wrapped_.wrap[i]))};
    if (!is_canonical(pair)) pair = swapped(pair);
    // A pair of a grain with itself at image zero has no canonical form and is skipped.
    if (!is_canonical(pair)) return;
    pairs_.push_back(pair);
    if (static_cast<double>(pairs_.size()) > kPairsAlways + most_per_grain_ * grains_.size())
      throw InputError("cell", fmt::format("the grains overlap so much, or attract each other across such wide "
                                           "gaps, that each has more than "
                                           "{:g} neighbours: a radius or the cell is wrong",
                                           most_per_grain_));
  }

  const Grains<Dim>& grains_;
  double gap_, most_per_grain_;
  ReducedLattice<Dim> lattice_;
  WrappedGrains<Dim> wrapped_;
  std::vector<NeighborPair<Dim>> pairs_;
};

/// Sorts pairs of grains by (i, j, image). A counting sort arranges the pairs by i; then the pairs with equal i are
/// sorted by comparison.
template <int Dim>
std::vector<NeighborPair<Dim>> sorted(const std::vector<NeighborPair<Dim>>& pairs, int n_grains) {
  std::vector<std::size_t> first(n_grains + 1, 0);
  for (const NeighborPair<Dim>& p : pairs) ++first[p.i + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<NeighborPair<Dim>> out(pairs.size());
  for (const NeighborPair<Dim>& p : pairs) out[next[p.i]++] = p;
  for (int i = 0; i < n_grains; ++i)
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first[i]),
              out.begin() + static_cast<std::ptrdiff_t>(first[i + 1]), precedes<NeighborPair<Dim>>);
  return out;
}

}  // namespace

template <int Dim>
std::vector<NeighborPair<Dim>> find_pairs(const Cell<Dim>& cell, const Grains<Dim>& grains, double gap,
                                          double most_per_grain) {
  check_finite(cell, grains);
  if (grains.size() == 0) return {};
  // The PairSearch object is temporary, so that its memory is free before the pairs are sorted.
  const std::vector<NeighborPair<Dim>> pairs = PairSearch<Dim>(cell, grains, gap, most_per_grain).all();
  return sorted(pairs, grains.size());
}

double most_pairs_in_memory(int n_grains) {
  return std::max(1000.0, kMostPairsInMemory / n_grains);
}

template <int Dim>
std::vector<NeighborPair<Dim>> find_wall_pairs(const std::vector<Wall<Dim>>& walls, const Grains<Dim>& grains,
                                               double gap) {
  std::vector<NeighborPair<Dim>> pairs;
  for (int i = 0; i < grains.size(); ++i)
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (walls[w].open) continue;
      const double distance = walls[w].side * (walls[w].position - grains.position[i][walls[w].axis]);
      if (distance < grains.radius[i] + gap)
        pairs.push_back({i, static_cast<int>(w), Vec<Dim, int>(Vec<Dim, int>::Zero())});
    }
  return pairs;
}

template std::vector<NeighborPair<2>> find_pairs(const Cell<2>&, const Grains<2>&, double, double);
template std::vector<NeighborPair<3>> find_pairs(const Cell<3>&, const Grains<3>&, double, double);
template std::vector<NeighborPair<2>> find_wall_pairs(const std::vector<Wall<2>>&, const Grains<2>&, double);
template std::vector<NeighborPair<3>> find_wall_pairs(const std::vector<Wall<3>>&, const Grains<3>&, double);

}  // namespace floc
