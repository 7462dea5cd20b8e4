#include "floc/assembly/vibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

#include "floc/assembly/gas.h"
#include "floc/base/error.h"
#include "floc/contact/pair_geometry.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Two grains are neighbours if the distance between their surfaces is at most this length (in largest diameters).
/// Collisions are predicted only between neighbours.
constexpr double kPairDistance = 0.4;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Hard grains that fly freely between collisions. For each grain, the position at its last event (collision or update)
/// is stored.
template <int Dim>
class HardFlight {
 public:
  explicit HardFlight(Packing<Dim>& packing)
      : packing_(packing),
        grains_(packing.grains),
        search_distance_(kPairDistance * largest_diameter(packing.grains)),
        time_of_(grains_.size(), 0.0),
        n_events_of_(grains_.size(), 0) {
    find_neighbours();
  }

  void fly(std::int64_t n_collisions) {
    for (std::int64_t done = 0; done < n_collisions && !events_.empty();) {
      const Event next = events_.top();
      events_.pop();
      // Grain i has collided since this event was predicted; the event will not happen.
      if (n_events_of_[next.i] != next.n_i) continue;
      if (n_events_of_[next.j] != next.n_j) {
        predict(next.i);
        continue;
      }
      now_ = next.time;
      bounce(next);
      ++done;
      if (has_gone_far(next.i) || has_gone_far(next.j)) {
        find_neighbours();
      } else {
        predict(next.i);
        predict(next.j);
      }
    }
    synchronise();
  }

 private:
  struct Neighbour {
    int grain;
    Vec<Dim> shift;  ///< vector from the grain to the close periodic image of the other grain (length)
  };
  struct Event {
    double time;
    int i, j;
    int n_i, n_j;  ///< numbers of collisions of grains i and j when this event was predicted
    Vec<Dim> shift;
    // with this order, the priority queue gives the earliest event first
    bool operator<(const Event& other) const { return time > other.time; }
  };

  Vec<Dim> place(int i) const { return grains_.position[i] + (now_ - time_of_[i]) * grains_.velocity[i]; }

  void bring_to_now(int i) {
    grains_.position[i] = place(i);
    time_of_[i] = now_;
  }
  void synchronise() {
    for (int i = 0; i < grains_.size(); ++i) bring_to_now(i);
  }

  void find_neighbours() {
    synchronise();
    neighbours_.assign(grains_.size(), {});
    for (const NeighborPair<Dim>& pair : find_pairs(packing_.cell, grains_, search_distance_)) {
      const Vec<Dim> shift = packing_.cell.shift(pair.image);
      neighbours_[pair.i].push_back({pair.j, shift});
      neighbours_[pair.j].push_back({pair.i, -shift});
    }
    start_ = grains_.position;
    events_ = {};
    for (int i = 0; i < grains_.size(); ++i) predict(i);
  }

  bool has_gone_far(int i) const { return (grains_.position[i] - start_[i]).norm() > 0.25 * search_distance_; }

  /// Returns the time until two grains collide; kNever if they do not collide.
  /// @param r  vector from the centre of the first grain to that of the second
  /// @param v  velocity of the second grain relative to the first
  /// @param contact_distance  sum of the radii
  static double time_to_meet(const Vec<Dim>& r, const Vec<Dim>& v, double contact_distance) {
    const double approach = -r.dot(v);
    if (!(approach > 0.0)) return kNever;
    const double beyond = r.squaredNorm() - contact_distance * contact_distance;
    const double squared = approach * approach - v.squaredNorm() * beyond;
    return squared < 0.0 ? kNever : std::max(0.0, beyond / (approach + std::sqrt(squared)));
  }

  /// Predicts the next collision of grain i with one of its neighbours, and adds this event to the queue of events.
  void predict(int i) {
    Event next{kNever, i, i, n_events_of_[i], 0, {}};
    const Vec<Dim> x = place(i);
    for (const Neighbour& n : neighbours_[i]) {
      const double time =
          now_ + time_to_meet(place(n.grain) + n.shift - x, grains_.velocity[n.grain] - grains_.velocity[i],
                              grains_.radius[i] + grains_.radius[n.grain]);
      if (time < next.time) next = {time, i, n.grain, n_events_of_[i], n_events_of_[n.grain], n.shift};
    }
    if (next.time < kNever) events_.push(next);
  }

  void bounce(const Event& event) {
    const int i = event.i, j = event.j;
    bring_to_now(i);
    bring_to_now(j);
    const Vec<Dim> n = (grains_.position[j] + event.shift - grains_.position[i]).normalized();
    const double m = reduced(grains_.mass[i], grains_.mass[j]);
    const double impulse = 2.0 * m * n.dot(grains_.velocity[j] - grains_.velocity[i]);
    grains_.velocity[i] += impulse / grains_.mass[i] * n;
    grains_.velocity[j] -= impulse / grains_.mass[j] * n;
    ++n_events_of_[i];
    ++n_events_of_[j];
  }

  Packing<Dim>& packing_;
  Grains<Dim>& grains_;
  double search_distance_;
  double now_ = 0.0;
  std::vector<double> time_of_;
  std::vector<int> n_events_of_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<Vec<Dim>> start_;
  std::priority_queue<Event> events_;
};

}  // namespace

template <int Dim>
void collide(Packing<Dim>& packing, double collisions) {
  HardFlight<Dim>(packing).fly(std::llround(0.5 * collisions * packing.grains.size()));
}

template <int Dim>
void vibrate(Packing<Dim>& packing, const Vibration& vibration, RandomStream& random) {
  Grains<Dim>& g = packing.grains;
  packing.cell.matrix *= vibration.dilation;
  g.position_low.clear();
  for (Vec<Dim>& x : g.position) x *= vibration.dilation;
  packing.contacts.clear();
  if (const std::size_t overlaps = find_pairs(packing.cell, g, 0.0).size(); overlaps > 0)
    throw InputError(
        "assembly.vibration",
        fmt::format(
            "dilation = {}: {} pairs of grains still overlap; expected a dilation that separates all grains",
            vibration.dilation, overlaps));
  agitate(packing, 1.0, random);
  collide(packing, vibration.collisions);
  for (int i = 0; i < g.size(); ++i) {
    g.position[i] = packing.cell.wrapped(g.position[i]);
    g.velocity[i].setZero();
    g.angular_velocity[i].setZero();
  }
}

#define FLOC_INSTANTIATE(Dim)                   \
  template void collide(Packing<Dim>&, double); \
  template void vibrate(Packing<Dim>&, const Vibration&, RandomStream&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
