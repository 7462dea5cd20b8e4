#include "floc/rigid/separating_plates.h"

#include <algorithm>

#include "floc/geometry/frame.h"
#include "floc/rigid/implicit_step.h"

namespace floc {
namespace {

/// Mass of a plate divided by the mass of the lighter grain.
constexpr double kPlateMass = 1e-3;
/// A contact gets a part of the impulse of its pair only if its gap exceeds the smallest gap of the pair by at most
/// this value times the distance of the centres of the two grains.
constexpr double kSameGap = 1e-6;
/// Number of sweeps in which the impulse of a pair is divided among at most four contacts.
constexpr int kSharingSweeps = 50;
/// Weight of the sum of the squared impulses in the function that the sweeps of share_impulse() minimise. This sum
/// makes the impulses of the contacts more equal.
constexpr double kEvenly = 1e-3;

/// Returns the extent of a grain along a unit vector, measured from the centre of the grain (length).
double extent_along(const PlacedShape<3>& grain, const Vec<3>& direction) {
  return grain.scale * extent<3>(*grain.shape, grain.rotation.transpose() * direction);
}

}  // namespace

SeparatingPlates::SeparatingPlates(const Packing<3>& packing, const BodyMotion<3>& bodies,
                                   const std::vector<StepContact<3>>& contacts, const std::vector<double>& gaps,
                                   double reach, const Rates& rates)
    : n_bodies_(bodies.size()), gaps_(gaps), reach_(reach), rates_(rates), motion_(bodies) {
  const int n_contacts = static_cast<int>(contacts.size());
  for (int first = 0, last; first < n_contacts; first = last) {
    const StepContact<3>& c = contacts[first];
    // Contacts with different periodic images of a grain belong to different pairs. Their branch vectors differ by at
    // least a side of the cell.
    for (last = first + 1; last < n_contacts; ++last)
      if (contacts[last].i != c.i || contacts[last].j != c.j ||
          (contacts[last].branch - c.branch).norm() > 1e-6 * c.branch.norm())
        break;
    if (packing.is_wall(c.j)) {
      const int begin = static_cast<int>(contacts_.size());
      contacts_.insert(contacts_.end(), contacts.begin() + first, contacts.begin() + last);
      pairs_.push_back({true, first, last, begin, begin + last - first});
      continue;
    }
    const PlacedShape<3> one = packing.grains.placed(c.i), two = packing.grains.placed(c.j);
    const Vec<3> n = c.frame.col(0);
    Vec<3> centre = Vec<3>::Zero();
    double impulse = 0.0;
    for (int k = first; k < last; ++k) {
      centre += contacts[k].arm_i / (last - first);
      impulse += contacts[k].impulse[0];
    }
    // The plate is midway between the two grains at the start.
    centre += n * (0.5 * (extent_along(one, n) + n.dot(c.branch) - extent_along(two, -n)) - n.dot(centre));
    StepContact<3> with_first = c, with_second = c;
    with_first.j = with_second.i = add_plate(c, centre);
    add_vertices(one, with_first, false, centre, impulse);
    const int of_second = static_cast<int>(contacts_.size());
    add_vertices(two, with_second, true, centre, impulse);
    pairs_.push_back({false, first, last, of_second, static_cast<int>(contacts_.size())});
  }
}

/// Adds the plate of a pair. The initial velocity of the plate is the mean of the velocities of the two grains at the
/// centre of the plate.
/// @param centre  vector from the centre of the first grain to the centre of the plate (length)
/// @return index of the plate among the bodies
int SeparatingPlates::add_plate(const StepContact<3>& c, const Vec<3>& centre) {
  const Vec<3> velocity =
      0.5 * (motion_.velocity[c.i] + cross<double>(motion_.angular_velocity[c.i], centre) +
             motion_.velocity[c.j] + cross<double>(motion_.angular_velocity[c.j], Vec<3>(centre - c.branch)));
  const bool first_is_lighter = motion_.inverse_mass[c.i].maxCoeff() > motion_.inverse_mass[c.j].maxCoeff();
  const int lighter = first_is_lighter ? c.i : c.j;
  motion_.velocity.push_back(velocity);
  motion_.angular_velocity.push_back(RotationVector<3>::Zero());
  motion_.inverse_mass.push_back(motion_.inverse_mass[lighter] / kPlateMass);
  motion_.inverse_inertia.push_back(motion_.inverse_inertia[lighter] / kPlateMass);
  return motion_.size() - 1;
}

/// Adds the contacts of a plate with the vertices of one of its grains.
/// @param pattern  contact with the indices of the grain and of the plate; each new contact is a copy of this contact
/// with its own arms, bias and impulse
/// @param impulse  total normal impulse of the pair in the last step
void SeparatingPlates::add_vertices(const PlacedShape<3>& grain, StepContact<3> pattern, bool is_second,
                                    const Vec<3>& centre, double impulse) {
  const std::size_t begin = contacts_.size();
  const Vec<3> normal = pattern.frame.col(0), branch = pattern.branch;
  for (int v = 0; v < std::max(1, grain.shape->n_vertices()); ++v) {
    const Vec<3> arm = grain.rotation * (grain.scale * core_vertex<3>(*grain.shape, v));
    const Vec<3> from_plate = is_second ? Vec<3>(branch + arm - centre) : Vec<3>(arm - centre);
    const double gap = (is_second ? normal.dot(from_plate) : -normal.dot(from_plate)) - grain.rounding();
    if (gap > reach_) continue;
    pattern.arm_i = is_second ? from_plate : arm;
    pattern.arm_j = is_second ? arm : from_plate;
    pattern.branch = pattern.arm_i - pattern.arm_j;
    pattern.bias.setZero();
    pattern.bias[0] = gap * (gap > 0.0 ? rates_.closing : rates_.opening);
    contacts_.push_back(pattern);
  }
  for (std::size_t k = begin; k < contacts_.size(); ++k)
    contacts_[k].impulse = impulse / static_cast<double>(contacts_.size() - begin) * Vec<3>::Unit(0);
}

/// Returns the second derivatives of the gap of a vertex above a plate or a wall, in the form of gap_curvature(). Let n
/// be the normal and t the rotation vector of the plate, w the rotation vector of the grain, a the vector from the
/// centre of the grain to the vertex, and u_i and u_j the displacements of the two bodies. Up to its sign, the gap is
///
///     (n + t x n + t x (t x n)/2) . (u_j + w x a + w x (w x a)/2 - u_i + branch).
PairMatrix<3> SeparatingPlates::gap_curvature_at(const StepContact<3>& c) const {
  using Map = Eigen::Matrix<double, 3, 2 * kDofs<3>>;
  constexpr int kTurns = kRotations<3>;
  const Vec<3> n = c.frame.col(0);
  const bool is_second = c.i >= n_bodies_, has_plate = is_second || c.j >= n_bodies_;
  const int turn_of_grain = 3 + (is_second ? kDofs<3> : 0), turn_of_plate = 3 + kDofs<3> - (turn_of_grain - 3);
  const double sign = is_second ? 1.0 : -1.0;
  const Vec<3> arm = is_second ? c.arm_j : c.arm_i;
  PairMatrix<3> out = PairMatrix<3>::Zero();
  if (has_plate) {
    Map slide = Map::Zero(), turn = Map::Zero();
    slide.leftCols<3>() = -Mat<3>::Identity();
    slide.middleCols<3>(kDofs<3>) = Mat<3>::Identity();
    for (int a = 0; a < kTurns; ++a) {
      const RotationVector<3> unit = RotationVector<3>::Unit(a);
      slide.col(turn_of_grain + a) = sign * cross<double>(unit, arm);
      turn.col(turn_of_plate + a) = cross<double>(unit, n);
    }
    out = turn.transpose() * slide;
    out += PairMatrix<3>(out.transpose());
    out.block<kTurns, kTurns>(turn_of_plate, turn_of_plate) +=
        sign * turn_curvature(is_second ? c.arm_i : c.arm_j, n);
  }
  out.block<kTurns, kTurns>(turn_of_grain, turn_of_grain) += sign * turn_curvature(arm, n);
  return out;
}

/// Returns, for each contact, the matrix that gives the change of the momenta of its two bodies due to the rotation of
/// its impulse (convex_stiffness()).
std::vector<PairMatrix<3>> SeparatingPlates::stiffnesses(double dt) const {
  std::vector<PairMatrix<3>> out;
  for (const StepContact<3>& c : contacts_)
    out.push_back(c.impulse[0] > 0.0 ? convex_stiffness<3>(gap_curvature_at(c), dt * c.impulse[0])
                                     : PairMatrix<3>(PairMatrix<3>::Zero()));
  return out;
}

bool SeparatingPlates::solve(double dt, BodyMotion<3>& bodies, std::vector<StepContact<3>>& contacts) {
  const BodyMotion<3> free = motion_;
  if (!solve_at_once(motion_, contacts_, {})) return false;
  motion_ = free;
  if (!solve_at_once(motion_, contacts_, stiffnesses(dt))) return false;
  std::copy_n(motion_.velocity.begin(), n_bodies_, bodies.velocity.begin());
  std::copy_n(motion_.angular_velocity.begin(), n_bodies_, bodies.angular_velocity.begin());
  bodies.stretch = motion_.stretch;
  for (const Pair& pair : pairs_) share_impulse(pair, contacts);
  return true;
}

/// Divides the impulse of a pair among its closest contacts. The total impulse is exactly that of the pair; the moment
/// is as close to that of the pair as repulsive impulses allow.
void SeparatingPlates::share_impulse(const Pair& pair, std::vector<StepContact<3>>& contacts) const {
  if (pair.has_wall) {
    for (int k = pair.first; k < pair.last; ++k)
      contacts[k].impulse = contacts_[pair.begin + k - pair.first].impulse;
    return;
  }
  double total = 0.0;
  Vec<3> moment = Vec<3>::Zero();
  for (int k = pair.begin; k < pair.end; ++k) {
    total += contacts_[k].impulse[0];
    moment += contacts_[k].impulse[0] * contacts_[k].arm_j;
  }
  const double length = contacts[pair.first].branch.norm();
  const double least = *std::min_element(gaps_.begin() + pair.first, gaps_.begin() + pair.last);
  std::vector<int> sharing;
  for (int k = pair.first; k < pair.last; ++k) {
    contacts[k].impulse.setZero();
    if (gaps_[k] <= least + kSameGap * length) sharing.push_back(k);
  }
  // Sweeps over the contacts minimise |sum P a - moment|^2 + length^2 (sum P - total)^2 + kEvenly length^2 sum P^2 for
  // impulses P >= 0 with lever arms a. The sum of the impulses is then set exactly to `total`.
  const Vec<3> normal = contacts[pair.first].frame.col(0);
  const Mat<3> tangential = Mat<3>::Identity() - normal * normal.transpose();
  double sum = 0.0;
  Vec<3> reached = Vec<3>::Zero();
  for (int sweep = 0; sweep < kSharingSweeps; ++sweep)
    for (const int k : sharing) {
      const Vec<3> arm = tangential * contacts[k].arm_j;
      double& own = contacts[k].impulse[0];
      const double slope =
          arm.dot(tangential * moment - reached) + length * length * (total - sum - kEvenly * own);
      const double next = std::max(0.0, own + slope / (arm.squaredNorm() + length * length * (1.0 + kEvenly)));
      reached += (next - own) * arm;
      sum += next - own;
      own = next;
    }
  for (const int k : sharing) contacts[k].impulse[0] *= sum > 0.0 ? total / sum : 0.0;
}

}  // namespace floc
