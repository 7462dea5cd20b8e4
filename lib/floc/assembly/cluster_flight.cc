#include "floc/assembly/cluster_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floc/base/dense_solvers.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// The search for pairs of grains of different clusters goes beyond the distance at which the flight ends, by this
/// length (in largest diameters). The surfaces of all pairs that are not found are farther apart.
constexpr double kSearchDistance = 0.1;
/// Largest number of successive time intervals over which one call of fly() moves the clusters. Each interval ends
/// before the earliest time at which two clusters could meet.
constexpr int kMaxFlights = 1000;

/// Largest angle by which a tumbling cluster may turn in one step of the time integration (radians).
constexpr double kTumblingStep = 0.02;

/// Neighbour of a grain: the index of another grain, and the periodic image of this other grain that touches or
/// attracts the first grain.
template <int Dim>
struct Neighbor {
  int grain;
  Vec<Dim, int> image;
};

/// Returns the moment of inertia of a point of mass 1.
/// @param arm  vector from the centre of rotation to the point
Mat<1> point_inertia(const Vec<2>& arm) {
  return Mat<1>(arm.squaredNorm());
}
Mat<3> point_inertia(const Vec<3>& arm) {
  return arm.squaredNorm() * Mat<3>::Identity() - arm * arm.transpose();
}

RotationVector<2> spin_of(const Mat<1>& inertia, const RotationVector<2>& angular_momentum) {
  return angular_momentum / inertia(0, 0);
}
RotationVector<3> spin_of(const Mat<3>& inertia, const RotationVector<3>& angular_momentum) {
  return inertia.ldlt().solve(angular_momentum);
}

/// Returns an upper bound on the spin of a freely rotating body at any time. In 3D the spin changes while the body
/// tumbles, but the rotational energy of the body is constant.
/// @param spin  present spin of the body
double fastest_spin(const Mat<1>&, const RotationVector<2>& spin) {
  return std::abs(spin[0]);
}
double fastest_spin(const Mat<3>& inertia, const RotationVector<3>& spin) {
  const double least = symmetric_eigenvalues(inertia)[0];
  return std::sqrt(spin.dot(inertia * spin) / least);
}

/// Orientation and spin of a cluster in free flight.
template <int Dim>
struct Attitude;
template <>
struct Attitude<2> {
  double angle = 0.0;
  RotationVector<2> spin;

  /// @param flown  time since the flight of the cluster began
  void advance(const Mat<1>&, const RotationVector<2>&, double /*time*/, double flown) {
    angle = flown * spin[0];
  }
  Vec<2> turned(const Vec<2>& v) const { return Eigen::Rotation2Dd(angle) * v; }
  void turn(double& orientation) const { orientation += angle; }
};
template <>
struct Attitude<3> {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  RotationVector<3> spin;

  /// Integrates Euler's equations for the rotation of a rigid body over `time`, by the Runge-Kutta method of fourth
  /// order. The angular momentum is constant, and the tensor of inertia rotates with the body.
  void advance(const Mat<3>& inertia, const RotationVector<3>& spin_at_start, double time, double /*flown*/) {
    // A cluster that touches its own periodic image has no moment of inertia; the spin of the cluster is 0.
    if (spin_at_start.isZero(0.0)) return;
    const Vec<3> angular_momentum = inertia * spin_at_start;
    const Mat<3> inverse = inertia.inverse();
    const auto spin_at = [&](const Eigen::Quaterniond& q) {
      const Mat<3> turn = q.normalized().toRotationMatrix();
      return Vec<3>(turn * (inverse * (turn.transpose() * angular_momentum)));
    };
    const auto rate = [&](const Eigen::Quaterniond& q) {
      const Vec<3> w = spin_at(q);
      return Eigen::Vector4d(0.5 * (Eigen::Quaterniond(0.0, w[0], w[1], w[2]) * q).coeffs());
    };
    const auto moved = [](const Eigen::Quaterniond& q, const Eigen::Vector4d& by) {
      return Eigen::Quaterniond(Eigen::Vector4d(q.coeffs() + by));
    };
    const double steps = std::max(1.0, std::ceil(fastest_spin(inertia, spin_at_start) * time / kTumblingStep));
    const double dt = time / steps;
    for (double step = 0.0; step < steps; ++step) {
      const Eigen::Vector4d k1 = rate(rotation), k2 = rate(moved(rotation, 0.5 * dt * k1)),
                            k3 = rate(moved(rotation, 0.5 * dt * k2)), k4 = rate(moved(rotation, dt * k3));
      rotation = moved(rotation, dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)).normalized();
    }
    spin = spin_at(rotation);
  }
  Vec<3> turned(const Vec<3>& v) const { return rotation * v; }
  void turn(Eigen::Quaterniond& orientation) const { orientation = rotation * orientation; }
};

/// Rotates the tangential vectors that each contact stores, such as the elongations of its springs, by the rotation of
/// the cluster. Contact normals are not rotated, because they are computed anew before their next use.
/// @param turned  function that rotates a vector by the rotation of the cluster to which a given grain belongs
template <class Turned>
void turn_history(Packing<3>& packing, const Turned& turned) {
  for (const HistoryQuantity& q : history_quantities(packing.law, 3)) {
    if (!is_tangential(q.declared.kind)) continue;
    for (Contact<3>& c : packing.contacts)
      c.history.segment<3>(q.begin) = turned(c.i, Vec<3>(c.history.segment<3>(q.begin)));
  }
}

}  // namespace

template <int Dim>
ClusterFlight<Dim>::ClusterFlight(const Packing<Dim>& packing) {
  unwrap(packing);
  find_motions(packing);
}

/// Finds the clusters by a search along contacts, which starts from the first grain of each cluster. Also chooses a
/// periodic image of each grain, so that the grains of each cluster form one connected body.
template <int Dim>
void ClusterFlight<Dim>::unwrap(const Packing<Dim>& packing) {
  const int n = packing.grains.size();
  std::vector<std::vector<Neighbor<Dim>>> neighbors(n);
  for (const Contact<Dim>& c : packing.contacts) {
    neighbors[c.i].push_back({c.j, c.image});
    neighbors[c.j].push_back({c.i, -c.image});
  }
  cluster_of_.assign(n, -1);
  place_.resize(n);
  std::vector<Vec<Dim, int>> image(n, Vec<Dim, int>::Zero());
  for (int first = 0; first < n; ++first) {
    if (cluster_of_[first] >= 0) continue;
    const int k = static_cast<int>(clusters_.size());
    Cluster& cluster = clusters_.emplace_back();
    cluster_of_[first] = k;
    std::vector<int> reached{first};
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const int i = reached[next];
      // place_ is the position of the periodic image of the grain that the search reached first. With these positions,
      // the grains of a cluster form one connected body, even if a face of the cell cuts the cluster.
      place_[i] = packing.grains.position[i] + packing.cell.shift(image[i]);
      for (const Neighbor<Dim>& neighbor : neighbors[i]) {
        const int j = neighbor.grain;
        const Vec<Dim, int> there = image[i] + neighbor.image;
        if (cluster_of_[j] < 0) {
          cluster_of_[j] = k;
          image[j] = there;
          reached.push_back(j);
        } else if (image[j] != there) {
          // Contacts connect the cluster to its own periodic image. A cluster of this kind has neither a centre nor a
          // moment of inertia.
          cluster.winds = true;
        }
      }
    }
  }
}

template <int Dim>
void ClusterFlight<Dim>::find_motions(const Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
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
    const Vec<Dim> arm = place_[i] - cluster.centre;
    cluster.inertia += g.inertia(i) * Mat<kRotations<Dim>>::Identity() + g.mass[i] * point_inertia(arm);
    // The member `spin` first collects the angular momentum of the cluster; the spin is computed from it below.
    cluster.spin += g.inertia(i) * g.angular_velocity[i] +
                    moment<double>(arm, Vec<Dim>(g.mass[i] * (g.velocity[i] - cluster.velocity)));
    cluster.reach = std::max(cluster.reach, arm.norm());
  }
  for (Cluster& cluster : clusters_) {
    if (cluster.winds) continue;
    cluster.spin = spin_of(cluster.inertia, cluster.spin);
    cluster.fastest_spin = fastest_spin(cluster.inertia, cluster.spin);
  }
  double twice_energy = 0.0;
  for (int i = 0; i < g.size(); ++i) {
    const Cluster& cluster = clusters_[cluster_of_[i]];
    const Vec<Dim> rigid = cluster.velocity + cross<double>(cluster.spin, Vec<Dim>(place_[i] - cluster.centre));
    twice_energy += g.mass[i] * (g.velocity[i] - rigid).squaredNorm() +
                    g.inertia(i) * (g.angular_velocity[i] - cluster.spin).squaredNorm();
  }
  inner_energy_ = 0.5 * twice_energy / g.size();
}

/// Returns a lower bound on the time until the surfaces of two clusters are within the distance `nearest` (length). The
/// speed at which two surfaces approach each other is at most the sum of three speeds: the relative speed of the
/// centres of the two clusters and, for each cluster, its largest spin times the distance from its centre to its
/// farthest grain.
template <int Dim>
double ClusterFlight<Dim>::time_to_meet(const Packing<Dim>& packing, double nearest) const {
  const std::vector<double>& radius = packing.grains.radius;
  const double search_distance = nearest + kSearchDistance * largest_diameter(radius);
  double fastest = 0.0;
  for (const Cluster& c : clusters_) fastest = std::max(fastest, c.velocity.norm() + c.fastest_spin * c.reach);
  const auto time = [](double way, double speed) {
    return speed > 0.0 ? std::max(0.0, way) / speed : std::numeric_limits<double>::infinity();
  };
  double soonest = time(search_distance - nearest, 2.0 * fastest);
  for (const NeighborPair<Dim>& pair : find_pairs(packing.cell, packing.grains, search_distance)) {
    if (cluster_of_[pair.i] == cluster_of_[pair.j]) continue;
    const Cluster &a = clusters_[cluster_of_[pair.i]], &b = clusters_[cluster_of_[pair.j]];
    const Vec<Dim> branch =
        packing.grains.position[pair.j] - packing.grains.position[pair.i] + packing.cell.shift(pair.image);
    const double way = branch.norm() - radius[pair.i] - radius[pair.j] - nearest;
    const double speed = (a.velocity - b.velocity).norm() + a.fastest_spin * a.reach + b.fastest_spin * b.reach;
    soonest = std::min(soonest, time(way, speed));
  }
  return soonest;
}

template <int Dim>
double ClusterFlight<Dim>::fly(Packing<Dim>& packing, double nearest, double longest) const {
  Grains<Dim>& g = packing.grains;
  const std::vector<Vec<Dim>> start = g.position;
  double flown = 0.0;
  std::vector<Attitude<Dim>> attitude(clusters_.size());
  for (std::size_t k = 0; k < clusters_.size(); ++k) attitude[k].spin = clusters_[k].spin;
  for (int flight = 0; flight < kMaxFlights && flown < longest; ++flight) {
    const double time = std::min(time_to_meet(packing, nearest), longest - flown);
    if (!(time > 0.0)) break;
    flown += time;
    for (std::size_t k = 0; k < clusters_.size(); ++k)
      attitude[k].advance(clusters_[k].inertia, clusters_[k].spin, time, flown);
    for (int i = 0; i < g.size(); ++i) {
      const Cluster& cluster = clusters_[cluster_of_[i]];
      const Vec<Dim> arm = place_[i] - cluster.centre;
      g.position[i] = start[i] + flown * cluster.velocity + (attitude[cluster_of_[i]].turned(arm) - arm);
    }
  }
  for (int i = 0; i < g.size(); ++i) {
    const Cluster& cluster = clusters_[cluster_of_[i]];
    const Attitude<Dim>& now = attitude[cluster_of_[i]];
    g.velocity[i] = cluster.velocity + now.turned(Vec<Dim>(g.velocity[i] - cluster.velocity));
    if constexpr (Dim == 3) {
      // Change of the spin relative to the rotating cluster; it is zero unless the cluster tumbles.
      const RotationVector<Dim> change = now.spin - now.turned(cluster.spin);
      g.velocity[i] += cross<double>(change, now.turned(Vec<Dim>(place_[i] - cluster.centre)));
      g.angular_velocity[i] = now.turned(g.angular_velocity[i]) + change;
    }
    now.turn(g.orientation[i]);
  }
  if constexpr (Dim == 3)
    turn_history(packing, [&](int grain, const Vec<3>& v) { return attitude[cluster_of_[grain]].turned(v); });
  return flown;
}

template class ClusterFlight<2>;
template class ClusterFlight<3>;

}  // namespace floc
