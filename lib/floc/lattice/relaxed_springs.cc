#include "floc/lattice/relaxed_springs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/lattice/spring_preconditioner.h"

namespace floc {
namespace {

/// Largest number of springs that may open or close before the factor is replaced. Up to this number, conjugate
/// gradients with the old factor take less time than a new factor.
constexpr int kMostChanged = 60;
/// Largest number of conjugate-gradient steps with an old factor. If more steps are needed, a new factor is made.
constexpr int kStepsOnOldFactor = 30;
/// Largest number of unknowns for which a factor is cheap in 3D.
constexpr int kSmallInSpace = 20000;
/// Net forces on nodes count as rounding errors if they are below this share of the load and have stopped decreasing.
constexpr double kRounding = 1e-8;
/// A sample counts as not resisting its load if its strain is larger than this number times the affine strain. The
/// affine strain is the strain under the load if all springs are closed and all nodes follow the strain of the cell.
/// The preconditioner could not distinguish a still softer sample from a sample with free motions.
constexpr double kBeyond = 1e8;
/// A motion counts as free (without resistance) if its energy, divided by the energy that the preconditioner predicts
/// for it, is below this number.
constexpr double kNoEnergy = 1e-5;

template <int Dim, int Size>
class Springs final : public RelaxedSprings<Dim> {
 public:
  using Strains = Eigen::Matrix<double, kSymmetric<Dim>, 1>;

  Springs(const LatticeNetwork<Dim>& network, const RelaxationSettings& settings)
      : settings_(settings),
        springs_(spring_rows<Dim, Size>(network)),
        here_(network.n_nodes, -1),
        x_(Eigen::VectorXd::Zero(springs_.n_unknowns() + kSymmetric<Dim>)),
        active_(springs_.rows.size(), 1),
        prepared_(springs_.rows.size(), 0) {
    for (std::size_t k = 0; k < springs_.node.size(); ++k) here_[springs_.node[k]] = static_cast<int>(k);
    const bool by_factor =
        settings.method == LatticeMethod::factor ||
        (settings.method == LatticeMethod::automatic && (Dim == 2 || springs_.n_unknowns() <= kSmallInSpace));
    inverse_ = by_factor ? factor_preconditioner(springs_) : block_preconditioner(springs_);
    control_.imposed.setConstant(true);
    control_.value.setZero();
  }

  SpringRelaxationReport relax(const StrainControl<Dim>& control) override {
    SpringRelaxationReport report;
    set_control(control);
    if (springs_.rows.empty()) {
      report.holds = report.converged = control_.imposed.all();
      return report;
    }
    const double whole = norm_of_load(report);
    double before = std::numeric_limits<double>::infinity();
    for (; report.n_rounds < settings_.max_rounds; ++report.n_rounds) {
      const int n_changed = update_active();
      const Eigen::VectorXd down = -gradient();
      const bool factorized = prepare(report);
      const double norm = std::sqrt(std::max(0.0, down.dot(inverse_->apply(down))));
      report.imbalance = whole > 0.0 ? norm / whole : 0.0;
      const int steps_before = report.n_steps;
      // If there are motions that no spring resists, rounding errors leave net forces on nodes, and further
      // iterations do not reduce these forces.
      const bool is_rounding =
          n_changed == 0 && report.imbalance < kRounding && report.imbalance > 0.5 * before;
      report.converged = report.imbalance <= settings_.tolerance || is_rounding;
      before = report.imbalance;
      if (!report.converged) take_step(down, norm, whole, report);
      if (settings_.observe)
        settings_.observe({report.n_rounds + 1, count_open(), report.n_rounds == 0 ? 0 : n_changed,
                           report.n_steps - steps_before, report.imbalance, factorized});
      if (report.converged || !report.holds) break;
    }
    return report;
  }

  Eigen::MatrixXd tangent_stiffness() override {
    constexpr int kAll = kSymmetric<Dim>;
    // All strains are imposed in this function: one strain is 1, all others are zero, and only the nodes relax. The
    // control of the last relaxation is restored afterwards.
    inverse_->set_free(Eigen::Matrix<bool, kAll, 1>::Constant(false));
    SpringRelaxationReport report;
    refresh(report);
    const Eigen::Matrix<bool, kAll, 1> imposed = control_.imposed;
    control_.imposed.setConstant(true);
    Eigen::MatrixXd response(x_.size(), kAll);
    for (int a = 0; a < kAll; ++a) {
      Eigen::VectorXd start = Eigen::VectorXd::Zero(x_.size());
      start[springs_.n_unknowns() + a] = 1.0;
      Eigen::VectorXd load = -applied(start);
      load.template tail<kAll>().setZero();
      const double norm = std::sqrt(std::max(0.0, load.dot(inverse_->apply(load))));
      response.col(a) = start + solve(load, settings_.tolerance * norm, kMostSteps, report).direction;
    }
    control_.imposed = imposed;
    inverse_->set_free((!control_.imposed.array()).matrix());
    // The stiffness is C_ab = sum_r k_r o_ra o_rb, over the closed springs r, with the stiffness k_r of a spring and
    // its overlap o_ra if strain a is 1. The sum of spring forces times their derivatives with respect to the strains
    // would have errors of first order in the residual net forces on the nodes. This symmetric sum has only errors of
    // second order.
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(kAll, kAll);
    for (std::size_t r = 0; r < springs_.rows.size(); ++r) {
      if (!active_[r]) continue;
      Strains o;
      for (int a = 0; a < kAll; ++a) o[a] = overlap(r, response.col(a));
      stiffness += springs_.rows[r].stiffness * o * o.transpose();
    }
    return stiffness;
  }

  Strains strain() const override { return x_.template tail<kSymmetric<Dim>>(); }

  Strains load() const override {
    Strains sum = Strains::Zero();
    for (std::size_t r = 0; r < springs_.rows.size(); ++r)
      sum += force(static_cast<int>(r)) * springs_.on_strain[r];
    return sum;
  }

  double force(int row) const override {
    return active_[row] ? springs_.rows[row].stiffness * overlap(row, x_) : 0.0;
  }
  bool open(int row) const override { return !active_[row]; }
  const std::vector<int>& first_row() const override { return springs_.first_row; }

  Vec<Dim> displacement(int node) const override {
    if (here_[node] < 0) return Vec<Dim>::Zero();
    return x_.template segment<Dim>(Size * here_[node]);
  }

  int n_unknowns() const override { return springs_.n_unknowns(); }

  double energy() const override {
    double sum = 0.0;
    for (std::size_t r = 0; r < springs_.rows.size(); ++r)
      if (active_[r]) sum += 0.5 * springs_.rows[r].stiffness * std::pow(overlap(r, x_), 2);
    return sum;
  }

  void remove_element(int element) override {
    for (int r = springs_.first_row[element]; r < springs_.first_row[element + 1]; ++r) {
      springs_.rows[r].stiffness = 0.0;
      active_[r] = 0;
      std::erase(springs_.one_sided, r);
    }
  }

 private:
  static constexpr int kMostSteps = 50000;

  struct Direction {
    Eigen::VectorXd direction;
    bool reached = false;  // whether the net forces on the nodes are within the target
  };

  void set_control(const StrainControl<Dim>& control) {
    control_ = control;
    for (int a = 0; a < kSymmetric<Dim>; ++a)
      if (control.imposed[a]) x_[springs_.n_unknowns() + a] = control.value[a];
    inverse_->set_free((!control_.imposed.array()).matrix());
  }

  double overlap(std::size_t r, const auto& x) const {
    const auto& row = springs_.rows[r];
    return row.on_i.dot(x.template segment<Size>(Size * row.i)) +
           row.on_j.dot(x.template segment<Size>(Size * row.j)) +
           springs_.on_strain[r].dot(x.template tail<kSymmetric<Dim>>());
  }

  /// Returns the product K x with the stiffness matrix K of the active springs: forces on the nodes and on the strains
  /// of the cell. The entries of imposed strains are zero.
  /// @param x  displacements of the nodes, then the strains of the cell
  Eigen::VectorXd applied(const Eigen::VectorXd& x) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
    Strains of_strains = Strains::Zero();
    for (std::size_t r = 0; r < springs_.rows.size(); ++r) {
      if (!active_[r]) continue;
      const auto& row = springs_.rows[r];
      const double f = row.stiffness * overlap(r, x);
      out.template segment<Size>(Size * row.i) += f * row.on_i;
      out.template segment<Size>(Size * row.j) += f * row.on_j;
      of_strains += f * springs_.on_strain[r];
    }
    for (int a = 0; a < kSymmetric<Dim>; ++a)
      if (!control_.imposed[a]) out[springs_.n_unknowns() + a] = of_strains[a];
    return out;
  }

  Eigen::VectorXd gradient() const {
    Eigen::VectorXd out = applied(x_);
    for (int a = 0; a < kSymmetric<Dim>; ++a)
      if (!control_.imposed[a]) out[springs_.n_unknowns() + a] -= control_.value[a];
    return out;
  }

  /// Determines which one-sided springs are active, that is, in compression.
  /// @return number of springs that have opened or closed since the last call
  int update_active() {
    int n_changed = 0;
    for (const int r : springs_.one_sided) {
      const double o = overlap(r, x_);
      // A spring with zero overlap remains open or closed as it was. Therefore all springs are still closed at the
      // first deformation.
      const char now = o > 0.0 || (o == 0.0 && active_[r]) ? 1 : 0;
      n_changed += now != active_[r];
      active_[r] = now;
    }
    return n_changed;
  }

  int count_open() const {
    return static_cast<int>(std::count_if(springs_.one_sided.begin(), springs_.one_sided.end(),
                                          [&](int r) { return !active_[r]; }));
  }

  /// Returns the size of the load in the norm of the preconditioner: the square root of twice an energy. This energy is
  /// the sum of two terms: the energy of the imposed strain if the nodes follow the strain affinely, and the energy
  /// that the nodes would then release by relaxation.
  double norm_of_load(SpringRelaxationReport& report) {
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(x_.size());
    for (int a = 0; a < kSymmetric<Dim>; ++a)
      if (control_.imposed[a]) kept[springs_.n_unknowns() + a] = control_.value[a];
    kept.swap(x_);
    prepare(report);
    const Eigen::VectorXd down = gradient();
    const double square = std::max(0.0, down.dot(inverse_->apply(down))) + 2.0 * energy();
    kept.swap(x_);
    return std::sqrt(square);
  }

  bool prepare(SpringRelaxationReport& report) {
    int n_changed = 0;
    for (std::size_t r = 0; r < active_.size() && n_changed <= kMostChanged; ++r)
      n_changed += active_[r] != prepared_[r];
    if (n_changed <= kMostChanged && ready_ && inverse_->is_exact()) return false;
    if (n_changed == 0 && ready_) return false;
    refresh(report);
    return true;
  }

  void refresh(SpringRelaxationReport& report) {
    if (ready_ && prepared_ == active_) return;
    inverse_->prepare(active_);
    prepared_ = active_;
    ready_ = true;
    ++report.n_factors;
  }

  /// Solves K d = load for the displacement d by conjugate gradients, with the stiffness matrix K of the active
  /// springs. The iteration ends when the residual, in the norm of the preconditioner, is at most `target`.
  Direction solve(const Eigen::VectorXd& load, double target, int most_steps,
                  SpringRelaxationReport& report) const {
    Direction out{Eigen::VectorXd::Zero(load.size())};
    Eigen::VectorXd r = load, z = inverse_->apply(r), p = z;
    double rz = r.dot(z);
    for (int step = 0; step < most_steps && rz > 0.0; ++step) {
      if (std::sqrt(rz) <= target) break;
      const Eigen::VectorXd q = applied(p);
      const double curvature = p.dot(q);
      if (curvature <= (inverse_->is_exact() ? kNoEnergy : 1e-14) * rz) {
        // No spring resists the direction p. In the first step, p itself is returned, because a motion along p may
        // close one-sided springs. In later steps, the direction found so far is returned.
        if (step == 0) out.direction = p;
        return out;
      }
      const double alpha = rz / curvature;
      out.direction += alpha * p;
      r -= alpha * q;
      z = inverse_->apply(r);
      const double next = r.dot(z);
      p = z + next / rz * p;
      rz = next;
      ++report.n_steps;
    }
    out.reached = std::sqrt(std::max(0.0, rz)) <= target;
    return out;
  }

  double largest_strain() const {
    double stiffness = 0.0, load = 0.0, imposed = 0.0;
    for (int a = 0; a < kSymmetric<Dim>; ++a) {
      double of_strain = 0.0;
      for (std::size_t r = 0; r < springs_.rows.size(); ++r)
        of_strain += springs_.rows[r].stiffness * std::pow(springs_.on_strain[r][a], 2);
      stiffness = std::max(stiffness, of_strain);
      double& size = control_.imposed[a] ? imposed : load;
      size = std::max(size, std::abs(control_.value[a]));
    }
    return stiffness > 0.0 ? kBeyond * (load / stiffness + imposed) : 0.0;
  }

  void take_step(const Eigen::VectorXd& down, double norm, double whole, SpringRelaxationReport& report) {
    const bool one_sided = !springs_.one_sided.empty();
    // As long as springs open and close, an inexact direction is sufficient. If the inverse is nearly exact, a much
    // more accurate direction is cheap, and the result is more accurate.
    const double share = inverse_->is_exact() ? 1e-8 : one_sided ? 0.03 : 0.0;
    const double target = std::max(share * norm, 0.5 * settings_.tolerance * whole);
    const bool old_factor = inverse_->is_exact() && prepared_ != active_;
    Direction step = solve(down, target, old_factor ? kStepsOnOldFactor : kMostSteps, report);
    if (old_factor && !step.reached) {
      refresh(report);
      step = solve(down, target, kMostSteps, report);
    }
    if (!search_along(step.direction, down)) report.holds = false;
    if (strain().norm() > largest_strain()) report.holds = false;
  }

  /// Moves the nodes and strains along a direction, to the point of smallest energy.
  /// @param direction  displacements of the nodes, then the strains
  /// @param down       minus the gradient of the energy
  /// @return false if the energy decreases without limit
  bool search_along(const Eigen::VectorXd& direction, const Eigen::VectorXd& down) {
    const double slope = -down.dot(direction);
    if (slope >= 0.0) return true;
    double
        square = 0.0,
        // After a step of t times the direction, the slope of the energy of the two-sided springs along the direction
        // is linear + t * square.
        linear = slope;
    // for each one-sided spring: overlap, change of the overlap per unit step along the direction, stiffness
    std::vector<std::array<double, 3>> one_sided;
    for (const int r : springs_.one_sided) {
      const double o = overlap(r, x_), d = overlap(r, direction);
      one_sided.push_back({o, d, springs_.rows[r].stiffness});
      linear -= springs_.rows[r].stiffness * std::max(o, 0.0) * d;
    }
    std::size_t next = 0;
    for (std::size_t r = 0; r < springs_.rows.size(); ++r) {
      if (next < springs_.one_sided.size() && springs_.one_sided[next] == static_cast<int>(r)) {
        ++next;
        continue;
      }
      square += springs_.rows[r].stiffness * std::pow(overlap(r, direction), 2);
    }
    const auto slope_at = [&](double t, double& curvature) {
      double sum = linear + t * square;
      curvature = square;
      for (const auto& [o, d, k] : one_sided)
        if (o + t * d > 0.0) sum += k * (o + t * d) * d, curvature += k * d * d;
      return sum;
    };
    double t = 1.0, low = 0.0, high = std::numeric_limits<double>::infinity();
    constexpr int kMostTrials = 200;
    for (int trial = 0; trial < kMostTrials; ++trial) {
      double curvature = 0.0;
      const double at = slope_at(t, curvature);
      if (std::abs(at) <= (trial == 0 ? 0.3 : 1e-10) * -slope) break;
      (at < 0.0 ? low : high) = t;
      // The slope of the energy is piecewise linear. Therefore Newton's step is exact once the set of active springs no
      // longer changes.
      double to = curvature > 0.0 ? t - at / curvature : std::numeric_limits<double>::infinity();
      if (!(to > low && to < high)) to = std::isfinite(high) ? 0.5 * (low + high) : 4.0 * t;
      if (to > kForEver) return false;
      if (high - low <= 1e-15 * high) break;
      t = to;
    }
    x_ += t * direction;
    return true;
  }

  /// If the energy still decreases after this number of unit steps along a direction, the energy counts as decreasing
  /// without limit.
  static constexpr double kForEver = 1e12;

  RelaxationSettings settings_;
  SpringRows<Dim, Size> springs_;
  std::vector<int> here_;
  Eigen::VectorXd x_;  // displacements of the nodes, then the strains of the cell
  // for each spring, whether it is active now, and whether it was active when the preconditioner was made
  std::vector<char> active_, prepared_;
  bool ready_ = false;
  StrainControl<Dim> control_;
  std::unique_ptr<SpringPreconditioner<Dim, Size>> inverse_;
};

}  // namespace

template <int Dim>
std::unique_ptr<RelaxedSprings<Dim>> relaxed_springs(const LatticeNetwork<Dim>& network,
                                                     const RelaxationSettings& settings) {
  if (network.central()) return std::make_unique<Springs<Dim, Dim>>(network, settings);
  return std::make_unique<Springs<Dim, kDofs<Dim>>>(network, settings);
}

template std::unique_ptr<RelaxedSprings<2>> relaxed_springs(const LatticeNetwork<2>&,
                                                            const RelaxationSettings&);
template std::unique_ptr<RelaxedSprings<3>> relaxed_springs(const LatticeNetwork<3>&,
                                                            const RelaxationSettings&);

}  // namespace floc
