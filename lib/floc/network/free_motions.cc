#include "floc/network/free_motions.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "floc/base/dense_solvers.h"
#include "floc/network/components.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {
namespace {

/// Threshold for the linear independence of a rigid motion from the motions that are already fixed. The fixed motions
/// are subtracted from the rigid motion; the rigid motion is independent if more than this share of its largest
/// displacement remains. The value also serves as threshold for lever arms of normal forces: an arm, divided by the
/// size of the grain, counts as zero if it is smaller.
constexpr double kDistinct = 1e-6;

/// Returns the null space of a matrix up to rounding, as orthonormal columns v with |matrix v| <= bound.
/// @param matrix  matrix with at least as many rows as columns
Eigen::MatrixXd kernel(const Eigen::MatrixXd& matrix, double bound) {
  const SingularValues found = singular_values(matrix);
  const Eigen::Index rank = (found.values.array() > bound).count();
  return found.right.rightCols(matrix.cols() - rank);
}

template <int Dim>
using GrainMotion = Eigen::Matrix<double, kDofs<Dim>, 1>;

/// Returns the axes about which a connected part of the network can rotate as a rigid body while it remains connected
/// to its periodic images.
std::vector<RotationVector<2>> free_axes(const Component<2>& part) {
  if (!part.winding.empty()) return {};
  return {RotationVector<2>(1.0)};
}
std::vector<RotationVector<3>> free_axes(const Component<3>& part) {
  if (part.winding.size() > 1) return {};
  if (part.winding.size() == 1) return {part.winding[0].normalized()};
  return {Vec<3>::UnitX(), Vec<3>::UnitY(), Vec<3>::UnitZ()};
}

template <int Dim>
class FreeMotionFinder {
 public:
  explicit FreeMotionFinder(const ContactNetwork<Dim>& network)
      : network_(network),
        of_(contacts_of_grains(network)),
        active_(network.contacts.size(), true),
        first_held_(network.n_grains, -1) {
    free_.kept.assign(network.n_unknowns(), true);
    free_.dead_end.assign(network.n_grains, false);
  }

  FreeMotions find() {
    remove_dead_ends();
    add_rolls();
    find_free_spins();
    find_axis_spins();
    pin_components();
    free_.modes.resize(network_.n_unknowns(), static_cast<int>(free_.kind.size()));
    free_.modes.setFromTriplets(entries_.begin(), entries_.end());
    return std::move(free_);
  }

 private:
  /// A dead end: a grain that is connected by a single contact. All dead ends at the same grain form a linked list.
  struct DeadEnd {
    int grain;
    int contact;
    int next_held;  // index of the next dead end on the same grain; -1 at the end of the list
  };
  /// Common rotation of a group of grains that are not dead ends. No force or moment resists this rotation.
  struct CoreSpin {
    std::vector<int> grains;
    GrainMotion<Dim> motion;
    int pinned;  // unknown that is fixed, and not solved for, because of this rotation
  };

  void keep_grain(int grain, bool keep) {
    std::fill_n(free_.kept.begin() + first_unknown<Dim>(grain), kDofs<Dim>, keep);
  }

  int other_end(int contact, int grain) const {
    const NetworkContact<Dim>& c = network_.contacts[contact];
    return c.i == grain ? c.j : c.i;
  }

  void leave_alone(int grain) {
    ++free_.n_alone;
    keep_grain(grain, false);
    alone_.push_back(grain);
  }

  /// Removes dead ends one after another, beginning at the tips (grains with a single contact). The contacts between
  /// remaining grains stay active.
  void remove_dead_ends() {
    std::vector<int> degree(network_.n_grains);
    std::vector<int> tips;
    for (int i = 0; i < network_.n_grains; ++i) {
      degree[i] = static_cast<int>(of_[i].size());
      if (degree[i] == 0) leave_alone(i);
      if (degree[i] == 1) tips.push_back(i);
    }
    while (!tips.empty()) {
      const int tip = tips.back();
      tips.pop_back();
      // A tip without a contact is the last grain of a tree; its contact was removed together with its neighbour.
      if (degree[tip] != 1) continue;
      const int c = *std::find_if(of_[tip].begin(), of_[tip].end(), [&](int k) { return active_[k]; });
      const int holder = other_end(c, tip);
      active_[c] = false;
      free_.dead_end[tip] = true;
      keep_grain(tip, false);
      if (network_.contacts[c].kn < 0.0) ++free_.n_unstable_ends;
      if (network_.contacts[c].on_wall()) {
        dead_ends_.push_back({tip, c, -1});
        degree[tip] = 0;
        continue;
      }
      dead_ends_.push_back({tip, c, first_held_[holder]});
      first_held_[holder] = static_cast<int>(dead_ends_.size()) - 1;
      degree[tip] = 0;
      if (--degree[holder] == 1) tips.push_back(holder);
      if (degree[holder] == 0) leave_alone(holder);
    }
  }

  void add_grain(int grain, const GrainMotion<Dim>& motion) {
    for (int u = 0; u < kDofs<Dim>; ++u)
      if (motion[u] != 0.0)
        entries_.emplace_back(first_unknown<Dim>(grain) + u, static_cast<int>(free_.kind.size()), motion[u]);
  }

  /// Adds a motion of one grain to the current free motion. Dead ends at this grain move together with it, so that
  /// their contacts do not change.
  void add_with_dead_ends(int grain, const GrainMotion<Dim>& motion) {
    std::vector<std::pair<int, GrainMotion<Dim>>> moved{{grain, motion}};
    while (!moved.empty()) {
      const auto [holder, its_motion] = moved.back();
      moved.pop_back();
      add_grain(holder, its_motion);
      for (int d = first_held_[holder]; d >= 0; d = dead_ends_[d].next_held) {
        const ContactRows<Dim> g = contact_rows(network_.contacts[dead_ends_[d].contact]);
        const bool tip_is_i = network_.contacts[dead_ends_[d].contact].i == dead_ends_[d].grain;
        const auto& on_tip = tip_is_i ? g.on_i : g.on_j;
        const auto& on_holder = tip_is_i ? g.on_j : g.on_i;
        moved.emplace_back(dead_ends_[d].grain, -on_tip.partialPivLu().solve(on_holder * its_motion));
      }
    }
  }

  void finish_mode(FreeMotionKind kind) { free_.kind.push_back(kind); }

  /// Adds the free motions of grains without contact and of dead ends. Grains without contact can move in every way. A
  /// dead end can move relative to its neighbour in every component of the motion for which their contact has no
  /// stiffness.
  void add_rolls() {
    for (const int grain : alone_)
      for (int u = 0; u < kDofs<Dim>; ++u) {
        add_with_dead_ends(grain, GrainMotion<Dim>::Unit(u));
        finish_mode(of_[grain].empty() ? FreeMotionKind::rattler
                    : u < Dim          ? FreeMotionKind::translation
                                       : FreeMotionKind::rotation);
      }
    for (const DeadEnd& end : dead_ends_) {
      const NetworkContact<Dim>& c = network_.contacts[end.contact];
      const ContactRows<Dim> g = contact_rows(c);
      const RowStiffness<Dim> k = row_stiffness(c);
      const auto on_tip = (c.i == end.grain ? g.on_i : g.on_j).partialPivLu();
      for (int a = 0; a < kDofs<Dim>; ++a) {
        if (k[a] != 0.0) continue;
        add_with_dead_ends(end.grain, on_tip.solve(GrainMotion<Dim>::Unit(a)));
        finish_mode(FreeMotionKind::roll);
      }
      free_.n_free_rollers += (k.array() == 0.0).any() ? 1 : 0;
    }
  }

  void add_spin(const std::vector<int>& grains, const GrainMotion<Dim>& motion, int pinned) {
    free_.kept[pinned] = false;
    for (const int grain : grains) add_with_dead_ends(grain, motion);
    finish_mode(FreeMotionKind::spin);
    spins_.push_back({grains, motion, pinned});
  }

  /// Returns a group of grains: `start` and all grains that are connected to `start` by rolling or twisting stiffness,
  /// directly or through other grains. The group is empty if a tangential spring or a wall resists its rotation.
  std::vector<int> free_rolling_group(int start, std::vector<bool>& visited) const {
    bool held = false;
    std::vector<int> group{start};
    visited[start] = true;
    for (std::size_t at = 0; at < group.size(); ++at) {
      for (const int k : of_[group[at]]) {
        if (!active_[k]) continue;
        const NetworkContact<Dim>& c = network_.contacts[k];
        if (c.kt != 0.0 || (c.on_wall() && (c.kr != 0.0 || c.ktw != 0.0))) held = true;
        const int other = other_end(k, group[at]);
        if ((c.kr == 0.0 && c.ktw == 0.0) || visited[other]) continue;
        visited[other] = true;
        group.push_back(other);
      }
    }
    return held ? std::vector<int>{} : group;
  }

  /// Returns, as columns, the axes about which a group of grains can rotate together without resistance of normal
  /// springs. Round grains can rotate about all axes, because their normal forces have no moments about the centres. In
  /// the row in which a column has its largest entry, all later columns are zero.
  Eigen::MatrixXd axes_without_moment(const std::vector<int>& group) const {
    constexpr int kAxes = kRotations<Dim>;
    // number of rows; it includes kAxes rows of zeros, because kernel() needs at least as many rows as columns
    Eigen::Index n = kAxes;
    for (const int grain : group) n += static_cast<Eigen::Index>(of_[grain].size());
    Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(n, kAxes);
    n = kAxes;
    for (const int grain : group)
      for (const int k : of_[grain])
        if (active_[k])
          moments.row(n++) =
              normal_moment(network_.contacts[k], grain).transpose() / network_.grain_size[grain];
    if (moments.cwiseAbs().maxCoeff() <= kDistinct) return Eigen::MatrixXd::Identity(kAxes, kAxes);
    Eigen::MatrixXd axes = kernel(moments, kDistinct);
    for (Eigen::Index a = 0; a < axes.cols(); ++a) {
      Eigen::Index row = 0;
      axes.col(a).cwiseAbs().maxCoeff(&row);
      for (Eigen::Index b = a + 1; b < axes.cols(); ++b)
        axes.col(b) -= axes(row, b) / axes(row, a) * axes.col(a);
    }
    return axes;
  }

  /// Finds free rotations of grains, which no force or moment resists. A grain without tangential springs rotates
  /// freely if its normal forces have no moments. Grains that are connected by rolling or twisting stiffness rotate
  /// together.
  void find_free_spins() {
    std::vector<bool> visited(network_.n_grains, false);
    for (int i = 0; i < network_.n_grains; ++i) {
      const int first = first_unknown<Dim>(i);
      if (visited[i] || !free_.kept[first]) continue;
      const std::vector<int> group = free_rolling_group(i, visited);
      if (group.empty()) continue;
      const Eigen::MatrixXd axes = axes_without_moment(group);
      if (axes.cols() > 0) ++free_.n_free_spins;
      for (Eigen::Index a = 0; a < axes.cols(); ++a) {
        GrainMotion<Dim> motion = GrainMotion<Dim>::Zero();
        motion.template tail<kRotations<Dim>>() = axes.col(a);
        Eigen::Index largest = 0;
        axes.col(a).cwiseAbs().maxCoeff(&largest);
        add_spin(group, motion, first + Dim + static_cast<int>(largest));
      }
    }
  }

  /// Finds free rotations about an axis. A sphere with exactly two contacts rotates freely about the line through these
  /// contacts if neither contact has rolling or twisting stiffness.
  void find_axis_spins() {
    if constexpr (Dim == 3) {
      for (int i = 0; i < network_.n_grains; ++i) {
        if (!free_.kept[first_unknown<3>(i)]) continue;
        std::vector<Vec<3>> points;
        bool holds_spin = false;
        for (const int k : of_[i]) {
          if (!active_[k]) continue;
          const NetworkContact<3>& c = network_.contacts[k];
          points.push_back(c.i == i ? c.arm_i : c.arm_j);
          const bool own_image = c.i == c.j && !c.on_wall();
          holds_spin = holds_spin || c.kr != 0.0 || c.ktw != 0.0 || c.kt == 0.0 || own_image;
        }
        if (points.size() != 2 || holds_spin) continue;
        const Vec<3> axis = (points[1] - points[0]).normalized();
        GrainMotion<3> motion;
        motion << -cross<double>(axis, points[0]), axis;
        Eigen::Index largest = 0;
        axis.cwiseAbs().maxCoeff(&largest);
        ++free_.n_free_spins;
        add_spin({i}, motion, first_unknown<3>(i) + 3 + static_cast<int>(largest));
      }
    }
  }

  /// Returns the motion of a grain in a rigid motion of a connected part.
  /// @param place  position of the grain in the part (length)
  /// @param m      number of the rigid motion; translations along the coordinate axes come first, then rotations about
  /// `axes`
  GrainMotion<Dim> rigid_motion(const Vec<Dim>& place, int m,
                                const std::vector<RotationVector<Dim>>& axes) const {
    GrainMotion<Dim> motion = GrainMotion<Dim>::Zero();
    if (m < Dim)
      motion[m] = 1.0;
    else
      motion << cross<double>(axes[m - Dim], place), axes[m - Dim];
    return motion;
  }

  /// Returns the distance from the first grain of a part to its farthest point (length). Rotations are multiplied by
  /// this distance to make them comparable to displacements.
  double reach_of(const Component<Dim>& part) const {
    double reach = 0.0;
    for (std::size_t k = 0; k < part.grains.size(); ++k)
      reach = std::max(reach, part.place[k].norm() + network_.grain_size[part.grains[k]]);
    return reach;
  }

  /// Returns those rigid motions of a connected part that no wall resists. Each column is one motion, as a linear
  /// combination of the Dim translations and the rotations about `axes`.
  /// @param axes    free_axes() of the part
  /// @param reach   reach_of() the part (length)
  /// @param row_of  for each grain of the part, its first row among the unknowns of the part
  Eigen::MatrixXd free_of_walls(const Component<Dim>& part, const std::vector<RotationVector<Dim>>& axes,
                                double reach, const std::vector<int>& row_of) const {
    const auto n = Dim + static_cast<Eigen::Index>(axes.size());
    if (part.on_walls.empty()) return Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
    scale.tail(n - Dim).setConstant(1.0 / reach);
    Eigen::MatrixXd felt(kDofs<Dim> * part.on_walls.size(), n);
    for (std::size_t k = 0; k < part.on_walls.size(); ++k) {
      const NetworkContact<Dim>& c = network_.contacts[part.on_walls[k]];
      const ContactRows<Dim> rows = contact_rows(c);
      const RowStiffness<Dim> stiffness = row_stiffness(c);
      for (Eigen::Index m = 0; m < n; ++m) {
        GrainMotion<Dim> change =
            rows.on_i * rigid_motion(part.place[row_of[c.i] / kDofs<Dim>], static_cast<int>(m), axes) *
            scale[m];
        change.template tail<kRotations<Dim>>() *= network_.grain_size[c.i];
        felt.col(m).template segment<kDofs<Dim>>(kDofs<Dim> * static_cast<Eigen::Index>(k)) =
            (stiffness.array() != 0.0).select(change, 0.0);
      }
    }
    // The first columns are the translations that no wall resists, the other columns are free motions that are
    // orthogonal to these translations.
    const double bound = kDistinct * felt.norm();
    const Eigen::MatrixXd slides = kernel(felt.leftCols(Dim), bound);
    Eigen::MatrixXd across = Eigen::MatrixXd::Zero(felt.rows() + slides.cols(), n);
    across.topRows(felt.rows()) = felt;
    across.block(felt.rows(), 0, slides.cols(), Dim) = felt.norm() * slides.transpose();
    const Eigen::MatrixXd rest = kernel(across, bound);
    Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(n, slides.cols() + rest.cols());
    shares.topLeftCorner(Dim, slides.cols()) = slides;
    shares.rightCols(rest.cols()) = scale.asDiagonal() * rest;
    return shares;
  }

  double unit(int grain, int dof) const { return dof < Dim ? 1.0 : network_.grain_size[grain]; }

  /// Subtracts a multiple of `spin`, a rotation of grains that is already fixed, from each rigid motion of the
  /// connected part that contains these grains. Afterwards the unknown that is fixed for `spin` is zero in all rigid
  /// motions.
  /// @param motions  rigid motions, one per column; the rows are the unknowns of the part, rotations multiplied by the
  /// grain size
  void take_out(const CoreSpin& spin, const std::vector<int>& row_of, Eigen::MatrixXd& motions) const {
    const int pinned_dof = spin.pinned % kDofs<Dim>;
    const int pinned_grain = spin.pinned / kDofs<Dim>;
    const Eigen::RowVectorXd share = motions.row(row_of[pinned_grain] + pinned_dof) /
                                     (spin.motion[pinned_dof] * unit(pinned_grain, pinned_dof));
    for (const int grain : spin.grains)
      for (int u = 0; u < kDofs<Dim>; ++u)
        motions.row(row_of[grain] + u) -= spin.motion[u] * unit(grain, u) * share;
    motions.row(row_of[pinned_grain] + pinned_dof).setZero();
  }

  /// Fixes one unknown for each rigid motion of a connected part: the unknown that changes most in this motion, after
  /// motions that are already fixed have been subtracted.
  /// @param spins   rotations of grains that are already fixed
  /// @param row_of  receives, for each grain of the part, its first row among the unknowns of the part
  void pin(const Component<Dim>& part, const std::vector<CoreSpin>& spins, std::vector<int>& row_of) {
    const std::vector<RotationVector<Dim>> axes = free_axes(part);
    const double reach = reach_of(part);
    const int n = static_cast<int>(part.grains.size());
    for (int k = 0; k < n; ++k) row_of[part.grains[k]] = kDofs<Dim> * k;
    const Eigen::MatrixXd shares = free_of_walls(part, axes, reach, row_of);
    if (shares.cols() == 0) return;  // the walls resist every rigid motion of the part
    const auto motion_at = [&](const Vec<Dim>& place, int m) {
      GrainMotion<Dim> motion = GrainMotion<Dim>::Zero();
      for (int k = 0; k < static_cast<int>(shares.rows()); ++k)
        if (shares(k, m) != 0.0) motion += shares(k, m) * rigid_motion(place, k, axes);
      return motion;
    };
    Eigen::MatrixXd motions(kDofs<Dim> * n, shares.cols());
    for (int k = 0; k < n; ++k) {
      for (int m = 0; m < motions.cols(); ++m) {
        motions.col(m).segment<kDofs<Dim>>(kDofs<Dim> * k) = motion_at(part.place[k], m);
        motions.col(m).segment<kRotations<Dim>>(kDofs<Dim> * k + Dim) *= network_.grain_size[part.grains[k]];
      }
    }
    const Eigen::RowVectorXd extent = motions.cwiseAbs().colwise().maxCoeff();
    for (const CoreSpin& spin : spins) take_out(spin, row_of, motions);
    for (int m = 0; m < motions.cols(); ++m) {
      Eigen::Index row = 0;
      const double most = motions.col(m).cwiseAbs().maxCoeff(&row);
      // If all grains of the part lie on a line, the rotation of the part about this line may already be fixed, because
      // rotations of its grains are fixed.
      if (!(most > kDistinct * extent[m])) continue;
      free_.kept[first_unknown<Dim>(part.grains[row / kDofs<Dim>]) + row % kDofs<Dim>] = false;
      const double turn = shares.col(m).tail(shares.rows() - Dim).norm() * reach;
      const bool turns = turn > kDistinct * (turn + shares.col(m).template head<Dim>().norm());
      if (turns) ++free_.n_free_rotations;
      for (int k = 0; k < n; ++k) add_with_dead_ends(part.grains[k], motion_at(part.place[k], m));
      finish_mode(turns ? FreeMotionKind::rotation : FreeMotionKind::translation);
      const Eigen::RowVectorXd pivot = motions.row(row) / motions(row, m);
      const Eigen::VectorXd column = motions.col(m);
      motions.noalias() -= column * pivot;
      motions.row(row).setZero();
    }
  }

  void pin_components() {
    const std::vector<Component<Dim>> parts = find_components(network_, of_, active_);
    free_.n_components = static_cast<int>(parts.size());
    std::vector<int> part_of(network_.n_grains, -1);
    for (int p = 0; p < free_.n_components; ++p)
      for (const int grain : parts[p].grains) part_of[grain] = p;
    std::vector<std::vector<CoreSpin>> spins(parts.size());
    for (const CoreSpin& spin : spins_) spins[part_of[spin.grains[0]]].push_back(spin);
    std::vector<int> row_of(network_.n_grains, -1);
    for (int p = 0; p < free_.n_components; ++p) pin(parts[p], spins[p], row_of);
  }

  const ContactNetwork<Dim>& network_;
  const Adjacency of_;
  std::vector<bool> active_;
  // for each grain, index of the first dead end at this grain; -1 if there is none
  std::vector<int> first_held_;
  std::vector<int> alone_;
  std::vector<DeadEnd> dead_ends_;  // in the order of their removal, which begins at the tips
  std::vector<CoreSpin> spins_;
  std::vector<Eigen::Triplet<double>> entries_;
  FreeMotions free_;
};

}  // namespace

int FreeMotions::n_dead_ends() const {
  return static_cast<int>(std::count(dead_end.begin(), dead_end.end(), true));
}

int FreeMotions::count(FreeMotionKind of_kind) const {
  return static_cast<int>(std::count(kind.begin(), kind.end(), of_kind));
}

template <int Dim>
FreeMotions find_free_motions(const ContactNetwork<Dim>& network) {
  return FreeMotionFinder<Dim>(network).find();
}

template <int Dim>
bool resists_rotation(const ContactNetwork<Dim>& network, const NetworkContact<Dim>& c, int grain) {
  return c.kt != 0.0 || c.kr != 0.0 || c.ktw != 0.0 ||
         normal_moment(c, grain).norm() > kDistinct * network.grain_size[grain];
}

template bool resists_rotation(const ContactNetwork<2>&, const NetworkContact<2>&, int);
template bool resists_rotation(const ContactNetwork<3>&, const NetworkContact<3>&, int);
template FreeMotions find_free_motions(const ContactNetwork<2>&);
template FreeMotions find_free_motions(const ContactNetwork<3>&);

}  // namespace floc
