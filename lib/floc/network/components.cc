#include "floc/network/components.h"

#include <algorithm>
#include <array>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Largest number of periodic cells that a chain of contacts may span between a grain and its own periodic image. Up to
/// this number, the arithmetic is exact.
constexpr std::int64_t kMaxCells = std::int64_t{1} << 40;

using Wide = __int128;  // integer type for products of three numbers up to kMaxCells

/// Set of at most Dim linearly independent integer vectors with components up to kMaxCells. Linear independence is
/// tested by exact arithmetic.
template <int Dim>
class Lattice {
 public:
  /// Adds a vector if it is linearly independent of the vectors already in the set.
  /// @return whether the vector was added
  bool extend(const CellCount<Dim>& w) {
    if (rank_ == Dim || !independent(w)) return false;
    vectors_[rank_++] = w;
    return true;
  }

 private:
  bool independent(const CellCount<Dim>& w) const {
    if (rank_ == 0) return !w.isZero();
    if (w.cwiseAbs().maxCoeff() > kMaxCells || vectors_[0].cwiseAbs().maxCoeff() > kMaxCells)
      throw InputError("contacts/image",
                       "a chain of contacts passes through more than 2^40 cells before it returns to the same "
                       "grain: the periodic image of at least one contact is wrong");
    const CellCount<Dim>& u = vectors_[0];
    const auto minor = [](const auto& a, const auto& b, int p, int q) {
      return Wide{a[p]} * b[q] - Wide{a[q]} * b[p];
    };
    if constexpr (Dim == 2) {
      return minor(u, w, 0, 1) != 0;
    } else {
      const CellCount<Dim>& v = rank_ == 1 ? w : vectors_[1];
      const Wide normal[] = {minor(u, v, 1, 2), minor(u, v, 2, 0), minor(u, v, 0, 1)};
      if (rank_ == 1) return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
      return normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2] != 0;
    }
  }

  std::array<CellCount<Dim>, Dim> vectors_;
  int rank_ = 0;
};

template <int Dim>
class Walk {
 public:
  Walk(const ContactNetwork<Dim>& network, const Adjacency& of, const std::vector<bool>& active)
      : network_(network),
        of_(of),
        active_(active),
        index_(network.n_grains, -1),
        image_(network.n_grains, CellCount<Dim>::Zero()) {}

  bool reached(int grain) const { return index_[grain] >= 0; }

  Component<Dim> from(int start) {
    Component<Dim> part{{start}, {Vec<Dim>::Zero()}, {}, {}};
    Lattice<Dim> lattice;
    index_[start] = 0;
    // `part.grains` is also the queue of a breadth-first search, so it grows in this loop. An iterator over this list
    // would become invalid.
    for (std::size_t at = 0; at < part.grains.size(); ++at) {
      const int grain = part.grains[at];
      for (const int k : of_[grain]) {
        if (!active_[k]) continue;
        const NetworkContact<Dim>& c = network_.contacts[k];
        if (c.on_wall()) {
          part.on_walls.push_back(k);
          continue;
        }
        const int sign = c.i == grain ? 1 : -1;
        const int other = c.i == grain ? c.j : c.i;
        const Vec<Dim> place = part.place[at] + sign * c.branch;
        const CellCount<Dim> image = image_[grain] + sign * c.image.template cast<std::int64_t>();
        // If `other` has been reached before, two chains of contacts lead to it, and the two chains form a loop. The
        // difference of the two images is the number of cells that the loop spans; it is zero for a loop that does not
        // wind around the cell. These integers decide, because the places of grains have rounding errors.
        if (!reached(other)) {
          index_[other] = static_cast<int>(part.grains.size());
          image_[other] = image;
          part.grains.push_back(other);
          part.place.push_back(place);
        } else if (lattice.extend(image - image_[other])) {
          part.winding.push_back(place - part.place[index_[other]]);
        }
      }
    }
    return part;
  }

 private:
  const ContactNetwork<Dim>& network_;
  const Adjacency& of_;
  const std::vector<bool>& active_;
  std::vector<int> index_;             // for each grain, its index in its part; -1 if it has not been reached
  std::vector<CellCount<Dim>> image_;  // for each grain, the periodic image that the search has assigned to it
};

}  // namespace

template <int Dim>
Adjacency contacts_of_grains(const ContactNetwork<Dim>& network) {
  Adjacency of(network.n_grains);
  for (int c = 0; c < static_cast<int>(network.contacts.size()); ++c) {
    of[network.contacts[c].i].push_back(c);
    if (!network.contacts[c].on_wall()) of[network.contacts[c].j].push_back(c);
  }
  return of;
}

template <int Dim>
std::vector<Component<Dim>> find_components(const ContactNetwork<Dim>& network, const Adjacency& of,
                                            const std::vector<bool>& active) {
  std::vector<Component<Dim>> parts;
  Walk<Dim> walk(network, of, active);
  for (int i = 0; i < network.n_grains; ++i) {
    const bool touched = std::any_of(of[i].begin(), of[i].end(), [&](int c) { return active[c]; });
    if (touched && !walk.reached(i)) parts.push_back(walk.from(i));
  }
  return parts;
}

#define FLOC_INSTANTIATE(Dim)                                                                        \
  template Adjacency contacts_of_grains(const ContactNetwork<Dim>&);                                 \
  template std::vector<Component<Dim>> find_components(const ContactNetwork<Dim>&, const Adjacency&, \
                                                       const std::vector<bool>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
