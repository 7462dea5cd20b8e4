#include "floc/rigid/least_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "floc/base/interruption.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/rotation.h"
#include "floc/packing/wall_forces.h"
#include "floc/rigid/contact_points.h"
#include "floc/rigid/plane_equations.h"
#include "floc/rigid/separating_planes.h"

namespace floc {
namespace {

constexpr int kMostDescentSteps = 3000;
/// Weight mu of the logarithms for the first and for the last minimum, in units of the pressure times the volume per
/// grain, and the factor from one weight to the next. At a minimum, a gap with the force f is about mu/f wide. With a
/// first weight of 1e-5, the first minimum takes hundreds of steps and is often not found. With a first weight of 1e-3,
/// the grains rearrange so far that the solid fraction grows by 0.01 (polyhedra, 20 and 200 grains).
constexpr double kFirstWeight = 1e-4, kLastWeight = 1e-11, kNextWeight = 0.2;
/// Value of kLastWeight for rounded grains. With a value of 1e-8, one more packing of eight (20 polyhedra with a
/// rounding of 0.05) did not come to rest.
constexpr double kLastWeightRounded = 1e-7;
/// If the decrement of a Newton step (PlaneStep::decrement), divided by mu, is below kNearMinimum, mu is decreased. At
/// the last mu, the minimum is reached if this ratio is below kAtMinimum. If mu were decreased earlier, steps at the
/// smaller mu could be only a thousandth of a Newton step long.
constexpr double kNearMinimum = 0.5, kAtMinimum = 1e-2;
/// Largest number of Newton steps for the last minimum.
constexpr int kMostLastSteps = 30;
/// Lengths in units of the largest diameter: largest displacement of a surface in a step, largest gap of the pairs that
/// get a plane, gap beyond which the second derivatives of gaps are left out (add_gaps()), and typical displacement of
/// a grain without contacts in a step.
constexpr double kLongestNewtonMove = 0.03, kReach = 0.15, kFarGap = 0.01, kRattlerMove = 0.02;
/// Smallest gap in the shrunk packing, divided by the radius of the smaller grain, and smallest size of the shrunk
/// grains, divided by their full size.
constexpr double kFirstGap = 2e-3, kLeastSize = 0.5;
/// Smallest share of each gap that remains after a step in which the grains grow.
constexpr double kGapAfterGrowth = 0.3;
/// Smallest share of a gap or of a multiplier that remains after any step.
constexpr double kKeptShare = 0.01;
/// At a minimum, each multiplier equals mu/gap. After a step, each multiplier is limited to values from mu/gap divided
/// by this factor to mu/gap times this factor.
constexpr double kFarMultiplier = 1e4;
/// A step is accepted if the objective decreases by at least this share of the decrease predicted to first order.
constexpr double kArmijo = 1e-4;
constexpr int kMostShares = 40;

/// Descent to the minimum of the objective. The objective is the work P V against the stresses on the cell and the
/// walls, plus the potential energy of gravity, minus mu sum log g, with a sum over all gaps g.
class Descent {
 public:
  Descent(Packing<3>& packing, const BoundaryLoad<3>& load)
      : packing_(packing),
        load_(load),
        unknowns_(packing, load),
        vertices_(packing.grains),
        equations_(unknowns_, packing.grains.size()),
        full_scale_(packing.grains.scale),
        full_radius_(packing.grains.radius),
        size_(largest_diameter(packing.grains)) {
    packing_.grains.position_low.clear();
  }

  LeastVolume run() {
    LeastVolume out;
    out.is_near = vertices_.are_rounded();
    if (!shrink()) {
      out.failure = "some grains overlap by more than half their size";
      return out;
    }
    const double unit = mean_stress() * packing_.cell.volume() / packing_.grains.size();
    mu_ = kFirstWeight * unit;
    const double last_mu = (out.is_near ? kLastWeightRounded : kLastWeight) * unit;
    find_planes();
    int last_steps = 0;
    bool grows = false;
    while (out.n_steps < kMostDescentSteps && last_steps < kMostLastSteps) {
      check_interruption();
      const double growth = grows ? 1.0 / growth_ - 1.0 : 0.0;
      const std::optional<PlaneStep> step = newton_step(growth);
      if (!step || !take(*step, growth)) {
        set_growth(1.0);
        out.failure = "no step decreases the volume, although the packing is not at a minimum";
        return out;
      }
      ++out.n_steps;
      if (std::exchange(grows, false)) continue;
      // A small decrement alone does not prove a minimum, because the decrement also vanishes at a saddle point. The
      // matrix of second derivatives must be positive definite, too.
      const bool is_last = mu_ <= last_mu;
      last_steps += is_last;
      if (is_last && step->is_convex && step->decrement < kAtMinimum * mu_) return out;
      if (is_last || !(step->decrement < kNearMinimum * mu_)) continue;
      // The grains grow to full size before mu decreases. At a minimum, a gap with the force f is about mu/f wide, and
      // each growth closes only a part of every gap.
      if (growth_ < 1.0)
        grows = true;
      else
        mu_ *= kNextWeight;
    }
    set_growth(1.0);
    out.failure = "no minimum was found in " + std::to_string(out.n_steps) + " steps";
    return out;
  }

  /// Sets the contacts of the packing: the contact points with gaps below `contact_gap` times the smaller diameter. The
  /// force of the plane of each pair is divided equally among the contact points of the pair.
  void set_contacts(double contact_gap) const {
    packing_.contacts = ContactPoints<3>().find_touching(packing_, contact_gap);
    std::vector<Contact<3>>& contacts = packing_.contacts;
    for (std::size_t first = 0, last; first < contacts.size(); first = last) {
      for (last = first; last < contacts.size() && same_pair(contacts[last], contacts[first]);) ++last;
      const SeparatingPlane* plane = plane_of(contacts[first], planes_);
      const double force = plane ? plane->force(vertices_.of(plane->i).size()) : 0.0;
      for (std::size_t k = first; k < last; ++k)
        contacts[k].normal_force = contacts[k].elastic_force = force / static_cast<double>(last - first);
    }
  }

 private:
  /// Returns the mean of the stresses that are not zero.
  double mean_stress() const {
    double sum = 0.0;
    int n = 0;
    for (int a = 0; a < 3; ++a)
      if (load_.stress[a] > 0.0) sum += load_.stress[a], ++n;
    return sum / std::max(1, n);
  }

  double wall_force(const Wall<3>& wall) const {
    return load_.stress[wall.axis] * wall_area(packing_, wall.axis);
  }

  /// Sets the size of each grain to a share of its full size.
  void set_growth(double share) {
    growth_ = share;
    scale(packing_.grains, share);
    vertices_ = GrainVertices(packing_.grains);
  }

  void scale(Grains<3>& grains, double share) const {
    for (std::size_t i = 0; i < full_scale_.size(); ++i) {
      grains.scale[i] = share * full_scale_[i];
      grains.radius[i] = share * full_radius_[i];
    }
  }

  /// Returns the size of the grains, divided by their full size, after a share of a step.
  double grown(double share, double growth) const {
    const bool is_full = growth > 0.0 && share == 1.0;  // exactly, without rounding errors
    return is_full ? 1.0 : growth_ * (1.0 + share * growth);
  }

  /// Shrinks the grains until none overlap. Returns false if they would become too small.
  bool shrink() {
    while (growth_ > kLeastSize) {
      double least = kFirstGap;
      for (const Contact<3>& c : ContactPoints<3>().find_touching(packing_, kFirstGap))
        least = std::min(least, c.gap / smaller_radius(packing_, c));
      if (least >= kFirstGap) return true;
      set_growth(growth_ * (1.0 - std::max(kFirstGap, -0.5 * least)));
    }
    set_growth(1.0);
    return false;
  }

  void find_planes() {
    planes_ = separating_planes(packing_, vertices_, unknowns_, kReach * size_, planes_);
    for (SeparatingPlane& p : planes_)
      for (std::size_t v = p.multiplier.size(); v < p.gap.size(); ++v) p.multiplier.push_back(mu_ / p.gap[v]);
    equations_.set_pattern(planes_);
    moved_ = 0.0;
  }

  /// @param growth  relative growth of the grains in the step, to which the packing yields
  std::optional<PlaneStep> newton_step(double growth) {
    equations_.reset();
    add_objective();
    // For each grain, a term mu |u|^2/(2 s^2) is added to the objective, with the displacement u of the grain and s =
    // kRattlerMove times the largest diameter. The term limits the steps of grains without contacts.
    const double stiffness = mu_ / std::pow(kRattlerMove * size_, 2);
    for (int i = 0; i < packing_.grains.size(); ++i)
      for (int a = 0; a < 6; ++a) {
        const int row = PlaneUnknowns::of_grain(i) + a;
        equations_.add(row, row, stiffness * (a < 3 ? 1.0 : std::pow(packing_.grains.radius[i], 2)));
      }
    equations_.add(planes_, vertices_, {.mu = mu_, .weak = mu_ / (kFarGap * size_), .growth = growth});
    return equations_.solve(planes_);
  }

  void add_objective() {
    const double volume = packing_.cell.volume(), mean = mean_stress();
    for (int a = 0; a < 3; ++a) {
      if (unknowns_.stretch[a] < 0) continue;
      equations_.add_load(unknowns_.stretch[a], -volume * load_.stress[a]);
      for (int b = 0; b < a; ++b)
        if (unknowns_.stretch[b] >= 0)
          equations_.add(unknowns_.stretch[a], unknowns_.stretch[b], volume * mean);
    }
    for (std::size_t w = 0; w < packing_.walls.size(); ++w)
      if (unknowns_.wall[w] >= 0)
        equations_.add_load(unknowns_.wall[w], -packing_.walls[w].side * wall_force(packing_.walls[w]));
    for (int i = 0; i < packing_.grains.size(); ++i)
      for (int a = 0; a < 3; ++a)
        equations_.add_load(PlaneUnknowns::of_grain(i) + a, packing_.grains.mass[i] * packing_.gravity[a]);
  }

  /// Returns the change of the objective due to a step, without the change of the logarithms.
  double objective_change(const Eigen::VectorXd& step) const {
    const double volume = packing_.cell.volume();
    double change = 0.0, sum = 0.0, logarithm = 0.0;
    for (int a = 0; a < 3; ++a) {
      if (unknowns_.stretch[a] < 0) continue;
      const double e = step[unknowns_.stretch[a]];
      change += volume * load_.stress[a] * e;
      sum += e;
      logarithm += std::log1p(e);
    }
    change += volume * mean_stress() * (std::expm1(logarithm) - sum);
    for (std::size_t w = 0; w < packing_.walls.size(); ++w)
      if (unknowns_.wall[w] >= 0)
        change += step[unknowns_.wall[w]] * packing_.walls[w].side * wall_force(packing_.walls[w]);
    for (int i = 0; i < packing_.grains.size(); ++i)
      change -= packing_.grains.mass[i] * packing_.gravity.dot(step.segment<3>(PlaneUnknowns::of_grain(i)));
    return change;
  }

  /// Returns the largest displacement of a surface in a step.
  double largest_move(const Eigen::VectorXd& step) const {
    double longest = 0.0, strain = 0.0;
    for (int i = 0; i < packing_.grains.size(); ++i) {
      const int at = PlaneUnknowns::of_grain(i);
      longest = std::max(
          longest, step.segment<3>(at).norm() + packing_.grains.radius[i] * step.segment<3>(at + 3).norm());
    }
    for (const int e : unknowns_.stretch)
      if (e >= 0) strain = std::max(strain, std::abs(step[e]));
    for (const int w : unknowns_.wall)
      if (w >= 0) longest = std::max(longest, std::abs(step[w]));
    return longest + 2.0 * size_ * strain;
  }

  /// Moves the packing by a share of a step and lets the grains grow by this share of `growth`. The share is halved until
  /// the objective decreases or, if the grains grow, until a part of each gap remains. Returns false if the objective
  /// decreases for no share.
  bool take(const PlaneStep& step, double growth) {
    const double move = largest_move(step.motion);
    double share = std::min(1.0, kLongestNewtonMove * size_ / move), share_of_multipliers = 1.0;
    // changes of the multipliers l of all gaps g: from l g + dl g + l dg = mu
    std::vector<std::vector<double>> changes(planes_.size());
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const SeparatingPlane& p = planes_[k];
      changes[k] = gap_changes(vertices_, p, step.own[k], growth);
      for (std::size_t v = 0; v < p.gap.size(); ++v) {
        double& change = changes[k][v];
        if (change < 0.0) share = std::min(share, (1.0 - kKeptShare) * p.gap[v] / -change);
        change = mu_ / p.gap[v] - p.multiplier[v] - p.multiplier[v] / p.gap[v] * change;
        if (change < 0.0)
          share_of_multipliers = std::min(share_of_multipliers, (1.0 - kKeptShare) * p.multiplier[v] / -change);
      }
    }
    int halvings = 0;
    while (!try_share(step, share, growth)) {
      if (++halvings == kMostShares) return false;
      share *= 0.5;
    }
    planes_.swap(trial_.planes);
    for (std::size_t k = 0; k < planes_.size(); ++k)
      for (std::size_t v = 0; v < planes_[k].gap.size(); ++v) {
        double& multiplier = planes_[k].multiplier[v];
        const double at_minimum = mu_ / planes_[k].gap[v];
        multiplier = std::clamp(multiplier + share_of_multipliers * changes[k][v], at_minimum / kFarMultiplier,
                                at_minimum * kFarMultiplier);
      }
    std::swap(packing_.grains, trial_.grains);
    std::swap(vertices_, trial_.vertices);
    move_boundary(share * step.motion);
    growth_ = grown(share, growth);
    moved_ += 2.0 * share * move + share * growth * size_;
    if (moved_ > 0.5 * kReach * size_) find_planes();
    return true;
  }

  /// Computes the grains and planes after a share of a step. Returns true if no gap becomes too small and, unless the
  /// grains grow, the objective decreases.
  bool try_share(const PlaneStep& step, double share, double growth) {
    move_grains(share * step.motion, grown(share, growth));
    const double least_ratio = growth > 0.0 ? kGapAfterGrowth : 0.5 * kKeptShare;
    trial_.planes.resize(planes_.size());
    double logarithms = 0.0, rounding = 0.0;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      SeparatingPlane& moved = trial_.planes[k];
      moved = moved_plane(planes_[k], step.motion, step.own[k], share, trial_.vertices);
      for (std::size_t v = 0; v < moved.gap.size(); ++v) {
        const double ratio = moved.gap[v] / planes_[k].gap[v];
        if (!(ratio > least_ratio)) return false;
        logarithms += std::log(ratio);
        rounding += std::numeric_limits<double>::epsilon() * size_ / moved.gap[v];
      }
    }
    if (growth > 0.0) return true;
    const double change = objective_change(share * step.motion) - mu_ * logarithms;
    return change <= -kArmijo * share * step.decrement + mu_ * (1e-6 + rounding);
  }

  void move_grains(const Eigen::VectorXd& step, double size) {
    trial_.grains = packing_.grains;
    scale(trial_.grains, size);
    for (int i = 0; i < trial_.grains.size(); ++i) {
      const int at = PlaneUnknowns::of_grain(i);
      Vec<3>& x = trial_.grains.position[i];
      for (int a = 0; a < 3; ++a)
        if (unknowns_.stretch[a] >= 0) x[a] *= 1.0 + step[unknowns_.stretch[a]];
      x += step.segment<3>(at);
      trial_.grains.orientation[i] =
          turned(trial_.grains.orientation[i], RotationVector<3>(step.segment<3>(at + 3)));
    }
    trial_.vertices = GrainVertices(trial_.grains);
  }

  void move_boundary(const Eigen::VectorXd& step) {
    for (int a = 0; a < 3; ++a)
      if (unknowns_.stretch[a] >= 0) packing_.cell.matrix.col(a) *= 1.0 + step[unknowns_.stretch[a]];
    for (std::size_t w = 0; w < packing_.walls.size(); ++w) {
      if (unknowns_.wall[w] < 0) continue;
      Wall<3>& wall = packing_.walls[w];
      wall.position += step[unknowns_.wall[w]];
      packing_.cell.matrix(wall.axis, wall.axis) += wall.side * step[unknowns_.wall[w]];
    }
  }

  /// Grains and planes after a share of a step.
  struct Trial {
    Grains<3> grains;
    GrainVertices vertices{Grains<3>{}};
    std::vector<SeparatingPlane> planes;
  };

  Packing<3>& packing_;
  const BoundaryLoad<3>& load_;
  PlaneUnknowns unknowns_;
  GrainVertices vertices_;
  std::vector<SeparatingPlane> planes_;
  PlaneEquations equations_;
  Trial trial_;
  std::vector<double> full_scale_, full_radius_;  ///< scale and radius of each grain at full size
  double size_;                                   ///< largest diameter
  double growth_ = 1.0;                           ///< present size of the grains, divided by their full size
  double mu_ = 0.0;                               ///< weight of the logarithms
  double moved_ = 0.0;  ///< largest possible change of a gap since the list of planes was made (length)
};

}  // namespace

LeastVolume minimise_volume(Packing<3>& packing, const BoundaryLoad<3>& load, double contact_gap) {
  Descent descent(packing, load);
  LeastVolume out = descent.run();
  stop_grains(packing);
  descent.set_contacts(contact_gap);
  return out;
}

}  // namespace floc
