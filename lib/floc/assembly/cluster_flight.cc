#include "floc/assembly/cluster_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Distance to which surfaces are searched for when clusters may meet, in largest diameters: beyond it they
/// have as far to go at least.
constexpr double kSearchDistance = 0.1;
/// Bounds from below on the time to the next meeting that are flown one after another.
constexpr int kMaxFlights = 1000;

/// A grain that another touches, in the image in which it does.
struct Neighbor {
  int grain;
  Vec<2, int> image;
};

}  // namespace

ClusterFlight::ClusterFlight(const Packing<2>& packing) {
  unwrap(packing);
  find_motions(packing);
}

/// Walks through each cluster along its contacts, from its first grain.
void ClusterFlight::unwrap(const Packing<2>& packing) {
  const int n = packing.grains.size();
  std::vector<std::vector<Neighbor>> neighbors(n);
  for (const Contact<2>& c : packing.contacts) {
    neighbors[c.i].push_back({c.j, c.image});
    neighbors[c.j].push_back({c.i, -c.image});
  }
  cluster_of_.assign(n, -1);
  place_.resize(n);
  std::vector<Vec<2, int>> image(n, Vec<2, int>::Zero());
  for (int first = 0; first < n; ++first) {
    if (cluster_of_[first] >= 0) continue;
    const int k = static_cast<int>(clusters_.size());
    Cluster& cluster = clusters_.emplace_back();
    cluster_of_[first] = k;
    std::vector<int> reached{first};
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const int i = reached[next];
      place_[i] = packing.grains.position[i] + packing.cell.shift(image[i]);
      for (const Neighbor& neighbor : neighbors[i]) {
        const int j = neighbor.grain;
        const Vec<2, int> there = image[i] + neighbor.image;
        if (cluster_of_[j] < 0) {
          cluster_of_[j] = k;
          image[j] = there;
          reached.push_back(j);
        } else if (image[j] != there) {
          cluster.winds = true;
        }
      }
    }
  }
}

void ClusterFlight::find_motions(const Packing<2>& packing) {
  const Grains<2>& g = packing.grains;
  for (int i = 0; i < g.size(); ++i) {
    Cluster& cluster = clusters_[cluster_of_[i]];
    cluster.mass += g.mass[i];
    cluster.centre += g.mass[i] * place_[i];
    cluster.velocity += g.mass[i] * g.velocity[i];
  }
  for (Cluster& cluster : clusters_) {
    cluster.centre /= cluster.mass;
    cluster.velocity /= cluster.mass;
  }
  for (int i = 0; i < g.size(); ++i) {
    Cluster& cluster = clusters_[cluster_of_[i]];
    if (cluster.winds) continue;
    const Vec<2> arm = place_[i] - cluster.centre;
    cluster.inertia += g.inertia(i) + g.mass[i] * arm.squaredNorm();
    cluster.spin += g.inertia(i) * g.angular_velocity[i][0] +
                    moment<double>(arm, Vec<2>(g.mass[i] * (g.velocity[i] - cluster.velocity)))[0];
    cluster.reach = std::max(cluster.reach, arm.norm());
  }
  for (Cluster& cluster : clusters_)
    if (!cluster.winds) cluster.spin /= cluster.inertia;
  double twice_energy = 0.0;
  for (int i = 0; i < g.size(); ++i) {
    const Cluster& cluster = clusters_[cluster_of_[i]];
    const Vec<2> rigid =
        cluster.velocity + cross<double>(RotationVector<2>(cluster.spin), Vec<2>(place_[i] - cluster.centre));
    twice_energy += g.mass[i] * (g.velocity[i] - rigid).squaredNorm() +
                    g.inertia(i) * std::pow(g.angular_velocity[i][0] - cluster.spin, 2);
  }
  inner_energy_ = 0.5 * twice_energy / g.size();
}

/// A bound from below: no two surfaces approach faster than their clusters do and turn.
double ClusterFlight::time_to_meet(const Packing<2>& packing, double nearest) const {
  const std::vector<double>& radius = packing.grains.radius;
  const double search_distance = nearest + kSearchDistance * largest_diameter(radius);
  double fastest = 0.0;
  for (const Cluster& c : clusters_)
    fastest = std::max(fastest, c.velocity.norm() + std::abs(c.spin) * c.reach);
  const auto time = [](double way, double speed) {
    return speed > 0.0 ? std::max(0.0, way) / speed : std::numeric_limits<double>::infinity();
  };
  double soonest = time(search_distance - nearest, 2.0 * fastest);
  for (const NeighborPair<2>& pair : find_pairs(packing.cell, packing.grains, search_distance)) {
    if (cluster_of_[pair.i] == cluster_of_[pair.j]) continue;
    const Cluster &a = clusters_[cluster_of_[pair.i]], &b = clusters_[cluster_of_[pair.j]];
    const Vec<2> branch =
        packing.grains.position[pair.j] - packing.grains.position[pair.i] + packing.cell.shift(pair.image);
    const double way = branch.norm() - radius[pair.i] - radius[pair.j] - nearest;
    const double speed =
        (a.velocity - b.velocity).norm() + std::abs(a.spin) * a.reach + std::abs(b.spin) * b.reach;
    soonest = std::min(soonest, time(way, speed));
  }
  return soonest;
}

double ClusterFlight::fly(Packing<2>& packing, double nearest, double longest) const {
  Grains<2>& g = packing.grains;
  const std::vector<Vec<2>> start = g.position;
  double flown = 0.0;
  for (int flight = 0; flight < kMaxFlights && flown < longest; ++flight) {
    const double time = std::min(time_to_meet(packing, nearest), longest - flown);
    if (!(time > 0.0)) break;
    flown += time;
    for (int i = 0; i < g.size(); ++i) {
      const Cluster& cluster = clusters_[cluster_of_[i]];
      const Vec<2> arm = place_[i] - cluster.centre;
      g.position[i] =
          start[i] + flown * cluster.velocity + (Eigen::Rotation2Dd(flown * cluster.spin) * arm - arm);
    }
  }
  for (int i = 0; i < g.size(); ++i) {
    const Cluster& cluster = clusters_[cluster_of_[i]];
    const double rotation = flown * cluster.spin;
    g.velocity[i] = cluster.velocity + Eigen::Rotation2Dd(rotation) * Vec<2>(g.velocity[i] - cluster.velocity);
    g.orientation[i] += rotation;
  }
  return flown;
}

}  // namespace floc
