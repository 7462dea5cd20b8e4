#include "floc/relaxation/explicit_dynamics.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "floc/contact/law_table.h"
#include "floc/neighbors/space_order.h"
#include "floc/packing/contact_forces.h"
#include "floc/relaxation/barrier.h"

namespace floc {
namespace {

/// A list that lives fewer steps than this costs more in rebuilding than a wider skin costs in idle pairs; one that
/// lives longer than the other carries idle pairs for nothing (measured at N = 1400: a rebuild costs about 15 steps).
constexpr int kShortListLife = 60;
constexpr int kLongListLife = 400;

/// Sum (or largest) of a term over the grains of a block, in eight interleaved parts: a fixed order that a processor
/// of any vector width can follow, and no chain of additions to wait for.
template <int kBlock, class Term>
double block_sum(const Term& term) {
  std::array<double, 8> part{};
  for (int k = 0; k < kBlock; k += 8)
    for (int l = 0; l < 8; ++l) part[l] += term(k + l);
  return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}
template <int kBlock, class Term>
double block_max(const Term& term) {
  std::array<double, 8> part{};
  for (int k = 0; k < kBlock; k += 8)
    for (int l = 0; l < 8; ++l) part[l] = lanes::max(part[l], term(k + l));
  return *std::max_element(part.begin(), part.end());
}

/// The same contact seen from the other grain.
template <int Dim>
NeighborPair<Dim> swapped(const NeighborPair<Dim>& p) {
  return {p.j, p.i, -p.image};
}

/// In 2D the tangential spring looks the same from both grains, the relative rotation changes sign.
template <class Law>
void swap_sides(ContactHistory<Law, 2>& history) {
  if constexpr (Law::kHasRolling) history.roll = -history.roll;
}

}  // namespace

template <int Dim, class Law>
ExplicitDynamics<Dim, Law>::ExplicitDynamics(const Packing<Dim>& packing, const Law& law,
                                             const CellControl<Dim>& control, const DynamicsSettings& settings)
    : origin_(packing),
      law_(law),
      control_(control),
      dt_(settings.time_step),
      skin_(settings.skin),
      threads_(settings.threads),
      largest_(2.0 * *std::max_element(packing.grains.radius.begin(), packing.grains.radius.end())),
      grains_(packing.grains, space_order(packing.cell, packing.grains), kBlock),
      side_(packing.cell.matrix.diagonal()),
      side_rate_(packing.cell.velocity.diagonal()),
      strain_rate_(side_rate_.cwiseQuotient(side_)) {
  origin_.contacts.clear();
  sums_.resize(n_blocks());
  rebuild_list();
  load_histories(packing);
  refresh_forces();
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::load_histories(const Packing<Dim>& packing) {
  std::vector<int> place(grains_.size());
  for (int k = 0; k < grains_.size(); ++k) place[grains_.index[k]] = k;
  for (const Contact<Dim>& c : packing.contacts) {
    ContactHistory<Law, Dim> history;
    if constexpr (Law::kHasFriction) history.shear = c.shear_spring;
    if constexpr (Law::kHasRolling) history.roll = c.rolling_spring;
    NeighborPair<Dim> key{place[c.i], place[c.j], c.image};
    if (key.j < key.i) {
      key = swapped(key);
      swap_sides<Law>(history);
    }
    const auto found = std::lower_bound(pairs_.key.begin(), pairs_.key.end(), key, before<Dim>);
    if (found != pairs_.key.end() && *found == key) pairs_.history[found - pairs_.key.begin()] = history;
  }
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::advance(int n_steps, Motion motion) {
  const int threads = std::min(threads_, n_blocks());  // a thread without a block would only wait
  Barrier barrier(threads);
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    const int thread = omp_get_thread_num();
    const int first = n_blocks() * thread / threads;
    const int last = n_blocks() * (thread + 1) / threads;
    for (int step = 0; step < n_steps; ++step) {
      if (thread == 0) begin_step();
      barrier.wait();
      for (int b = first; b < last; ++b) kick_and_drift(b);
      barrier.wait();
      const bool stale = list_is_stale();
      barrier.wait();  // all have looked before the list changes
      if (stale) {
        if (thread == 0) rebuild_list();
        barrier.wait();
      }
      for (int b = first; b < last; ++b) compute_pairs(b, dt_);
      barrier.wait();
      for (int b = first; b < last; ++b) sum_and_kick(b, 0.5 * dt_);
      barrier.wait();
      if (thread == 0) end_step(motion);
    }
  }
}

/// Half a step of acceleration of the sides: M L'' = (work - A Sigma)/L, the rate capped.
template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::kick_cell() {
  if (control_.fixed) return;
  Vec<Dim> work = Vec<Dim>::Zero();
  for (const BlockSums& s : sums_) work += s.virial + s.momentum_flux;
  const Vec<Dim> pull = work - side_.prod() * control_.target;
  side_rate_ += 0.5 * dt_ / control_.mass * pull.cwiseQuotient(side_);
  const Vec<Dim> limit = control_.rate_cap * side_;
  side_rate_ = side_rate_.cwiseMin(limit).cwiseMax(-limit);
}

/// Half kick of the cell, and how this step's drift deforms it. In reduced coordinates s' = v/L with L at mid-step,
/// which keeps the scheme symmetric in time.
template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::begin_step() {
  kick_cell();
  const Vec<Dim> middle = side_ + 0.5 * dt_ * side_rate_;
  const Vec<Dim> next = side_ + dt_ * side_rate_;
  strain_rate_ = side_rate_.cwiseQuotient(middle);
  stretch_ = next.cwiseQuotient(side_);
  drift_ = dt_ * next.cwiseQuotient(middle);
  side_ = next;
  list_stretch_ = side_.cwiseQuotient(side_list_);
  ++steps_since_list_;
}

template <int Dim, class Law>
typename ExplicitDynamics<Dim, Law>::Kick ExplicitDynamics<Dim, Law>::kick_over(double half_step) const {
  // v' = F/m - (L'/L) v, the second term taken at the middle of the half step.
  const Vec<Dim> drag = 0.5 * half_step * strain_rate_;
  const Vec<Dim> gain = (Vec<Dim>::Ones() + drag).cwiseInverse();
  return {half_step, (Vec<Dim>::Ones() - drag).cwiseProduct(gain), gain};
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::turn(const Kick& kick, int begin) {
  const double* const inverse_inertia = grains_.inverse_inertia.data() + begin;
  for (int a = 0; a < kRotations<Dim>; ++a) {
    const double* const torque = grains_.torque[a].data() + begin;
    double* const spin = grains_.spin[a].data() + begin;
#pragma omp simd
    for (int k = 0; k < kBlock; ++k) spin[k] += torque[k] * (kick.half_step * inverse_inertia[k]);
  }
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::kick_and_drift(int block) {
  const int begin = block * kBlock;
  const Kick half = kick_over(0.5 * dt_);
  const double* const inverse_mass = grains_.inverse_mass.data() + begin;
  std::array<double, kBlock> moved_squared{};
  for (int a = 0; a < Dim; ++a) {
    const double* const force = grains_.force[a].data() + begin;
    const double* const x_list = x_list_[a].data() + begin;
    double* const v = grains_.v[a].data() + begin;
    double* const x = grains_.x[a].data() + begin;
    const double keep = half.keep[a], gain = half.gain[a], stretch = stretch_[a], drift = drift_[a];
    const double list_stretch = list_stretch_[a];
#pragma omp simd
    for (int k = 0; k < kBlock; ++k) {
      const double kick = half.half_step * inverse_mass[k] * force[k];
      v[k] = v[k] * keep + kick * gain;
      x[k] = stretch * x[k] + drift * v[k];
      const double moved = x[k] - list_stretch * x_list[k];
      moved_squared[k] += moved * moved;
    }
  }
  if constexpr (kTurns) {
    turn(half, begin);
    const double* const spin = grains_.spin[0].data() + begin;
    double* const angle = grains_.angle.data() + begin;
#pragma omp simd
    for (int k = 0; k < kBlock; ++k) angle[k] += dt_ * spin[k];
  }
  sums_[block].displacement_squared = block_max<kBlock>([&](int k) { return moved_squared[k]; });
}

/// Nothing outside the list can interact while the affine shrinking and twice the largest displacement relative to it
/// eat less than the skin.
template <int Dim, class Law>
bool ExplicitDynamics<Dim, Law>::list_is_stale() const {
  double squared = 0.0;
  for (const BlockSums& s : sums_) squared = std::max(squared, s.displacement_squared);
  const double shrink = std::max(0.0, 1.0 - list_stretch_.minCoeff());
  return 2.0 * std::sqrt(squared) + shrink * (largest_ + law_.range() + skin_) >= skin_;
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::adapt_skin() {
  if (pairs_.size() == 0 || steps_since_list_ == 0) return;
  if (steps_since_list_ < kShortListLife) skin_ = std::min(1.3 * skin_, 0.5 * largest_);
  if (steps_since_list_ > kLongListLife) skin_ = std::max(0.7 * skin_, 1e-3 * largest_);
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::rebuild_list() {
  if (!finite()) return;  // the caller will ask; there are no neighbours to find
  adapt_skin();
  Grains<Dim> now = Grains<Dim>::with_size(grains_.size());
  grains_.copy_positions_to(now);
  now.radius.assign(grains_.radius.begin(), grains_.radius.begin() + grains_.size());
  Cell<Dim> cell;
  cell.matrix = side_.asDiagonal();
  HotPairs<Law, Dim> pairs(find_pairs(cell, now, law_.range() + skin_), now.radius, grains_.mass, law_, dt_);
  pairs.inherit(pairs_);
  pairs_ = std::move(pairs);
  x_list_ = grains_.x;
  side_list_ = side_;
  list_stretch_.setOnes();
  steps_since_list_ = 0;
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::compute_pairs(int block, double slip_time) {
  // Copies that no store of the loop can alias, so that their constants stay in registers.
  const Law law = law_;
  const Vec<Dim> side = side_;
  const Vec<Dim> rate = strain_rate_;
  Vec<Dim> virial = Vec<Dim>::Zero();
  const int end = pairs_.first_of_i[block_end(block)];
  for (int p = pairs_.first_of_i[block * kBlock]; p < end; ++p)
    compute_pair(p, law, side, rate, slip_time, virial);
  sums_[block].virial = virial;
}

template <int Dim, class Law>
[[gnu::always_inline]] inline void ExplicitDynamics<Dim, Law>::compute_pair(
    int p, const Law& law, const Vec<Dim>& side, const Vec<Dim>& rate, double slip_time, Vec<Dim>& virial) {
  const int i = pairs_.key[p].i;
  const int j = pairs_.key[p].j;
  Vec<Dim> r;
  for (int a = 0; a < Dim; ++a) r[a] = grains_.x[a][j] - grains_.x[a][i] + pairs_.image[a][p] * side[a];
  const double squared = r.squaredNorm();
  if (squared >= pairs_.reach_squared[p]) {
    for (int a = 0; a < Dim; ++a) pairs_.row_force[a][p] = 0.0;
    if constexpr (kTurns)
      for (int a = 0; a < kRotations<Dim>; ++a) pairs_.row_torque_i[a][p] = pairs_.row_torque_j[a][p] = 0.0;
    pairs_.history[p] = {};
    return;
  }
  const double distance = std::sqrt(squared);
  const Vec<Dim> n = r * (1.0 / distance);
  const Vec<Dim> affine = rate.cwiseProduct(r);

  ContactMotion<Dim> motion{distance - pairs_.radii[p], 0.0, pairs_.damping[p], Shear<Dim>::Zero(),
                            Spin<Dim>::Zero()};
  Vec<Dim> centres;
  for (int a = 0; a < Dim; ++a) centres[a] = grains_.v[a][j] - grains_.v[a][i] + affine[a];
  motion.gap_rate = n.dot(centres);
  const double arm_i = pairs_.share_i[p] * distance;
  const double arm_j = distance - arm_i;
  if constexpr (kTurns) {
    Spin<Dim> spin_i, spin_j;
    for (int a = 0; a < kRotations<Dim>; ++a) {
      spin_i[a] = grains_.spin[a][i];
      spin_j[a] = grains_.spin[a][j];
    }
    // Velocity of j's surface point against i's: both turn their surfaces the same way round.
    const Vec<Dim> surfaces = centres - cross<double>(Spin<Dim>(arm_i * spin_i + arm_j * spin_j), n);
    motion.slip = slip_time * to_shear<double>(n, surfaces);
    motion.relative_turn = slip_time * (spin_i - spin_j);
  }
  const ContactForces<Dim> f = law.respond(motion, pairs_.history[p]);

  Vec<Dim> on_j = (f.normal.force() + f.viscous) * n;
  if constexpr (kTurns) {
    const Vec<Dim> shear = from_shear<double>(n, f.shear);
    on_j -= shear;
    const Spin<Dim> unit = moment<double>(n, shear);
    for (int a = 0; a < kRotations<Dim>; ++a) {
      pairs_.row_torque_i[a][p] = arm_i * unit[a] - f.rolling[a];
      pairs_.row_torque_j[a][p] = arm_j * unit[a] + f.rolling[a];
    }
  }
  for (int a = 0; a < Dim; ++a) {
    pairs_.row_force[a][p] = on_j[a];
    virial[a] += on_j[a] * r[a];
  }
}

/// Sums the rows of one grain in the order of the pairs. Rows of pairs that do not interact are zero and leave no trace,
/// so the result does not depend on which of them the list holds. (The same holds for the virial of a block.)
template <int Dim, class Law>
inline void ExplicitDynamics<Dim, Law>::sum_forces(int k) {
  Vec<Dim> force = Vec<Dim>::Zero();
  Spin<Dim> torque = Spin<Dim>::Zero();
  for (int e = pairs_.first_with_j[k]; e < pairs_.first_with_j[k + 1]; ++e) {
    const int p = pairs_.with_j[e];
    for (int a = 0; a < Dim; ++a) force[a] += pairs_.row_force[a][p];
    if constexpr (kTurns)
      for (int a = 0; a < kRotations<Dim>; ++a) torque[a] += pairs_.row_torque_j[a][p];
  }
  for (int p = pairs_.first_of_i[k]; p < pairs_.first_of_i[k + 1]; ++p) {
    for (int a = 0; a < Dim; ++a) force[a] -= pairs_.row_force[a][p];
    if constexpr (kTurns)
      for (int a = 0; a < kRotations<Dim>; ++a) torque[a] += pairs_.row_torque_i[a][p];
  }
  for (int a = 0; a < Dim; ++a) grains_.force[a][k] = force[a];
  if constexpr (kTurns)
    for (int a = 0; a < kRotations<Dim>; ++a) grains_.torque[a][k] = torque[a];
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::sum_and_kick(int block, double half_step) {
  const int begin = block * kBlock;
  for (int k = begin; k < block_end(block); ++k) sum_forces(k);

  const Kick half = kick_over(half_step);
  const double* const mass = grains_.mass.data() + begin;
  const double* const inverse_mass = grains_.inverse_mass.data() + begin;
  BlockSums& sums = sums_[block];
  for (int a = 0; a < Dim; ++a) {
    const double* const force = grains_.force[a].data() + begin;
    double* const v = grains_.v[a].data() + begin;
    const double keep = half.keep[a], gain = half.gain[a];
#pragma omp simd
    for (int k = 0; k < kBlock; ++k) v[k] = v[k] * keep + half.half_step * inverse_mass[k] * force[k] * gain;
    sums.momentum_flux[a] = block_sum<kBlock>([&](int k) { return mass[k] * v[k] * v[k]; });
  }
  if constexpr (kTurns) {
    turn(half, begin);
    sums.rotation = 0.0;
    const double* const inertia = grains_.inertia.data() + begin;
    for (int a = 0; a < kRotations<Dim>; ++a) {
      const double* const spin = grains_.spin[a].data() + begin;
      sums.rotation += block_sum<kBlock>([&](int k) { return inertia[k] * spin[k] * spin[k]; });
    }
  }
}

template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::end_step(Motion motion) {
  kick_cell();
  if (motion != Motion::power_control) return;
  double twice_kinetic = 0.0;
  for (const BlockSums& s : sums_) twice_kinetic += s.momentum_flux.sum() + s.rotation;
  if (!control_.fixed) twice_kinetic += control_.mass * side_rate_.squaredNorm();
  if (twice_kinetic < kinetic_) {
    for (auto& component : grains_.v) std::fill(component.begin(), component.end(), 0.0);
    for (auto& component : grains_.spin) std::fill(component.begin(), component.end(), 0.0);
    for (BlockSums& s : sums_) s.momentum_flux.setZero(), s.rotation = 0.0;
    side_rate_.setZero();
    twice_kinetic = 0.0;
  }
  kinetic_ = twice_kinetic;
}

/// Forces of the present positions and velocities, histories untouched but for their caps.
template <int Dim, class Law>
void ExplicitDynamics<Dim, Law>::refresh_forces() {
  for (int b = 0; b < n_blocks(); ++b) compute_pairs(b, 0.0);
  for (int b = 0; b < n_blocks(); ++b) sum_and_kick(b, 0.0);
}

template <int Dim, class Law>
bool ExplicitDynamics<Dim, Law>::finite() const {
  bool all = side_.allFinite() && side_rate_.allFinite();
  for (const auto& component : grains_.x)
    for (const double x : component) all = all && std::isfinite(x);
  return all;
}

template <int Dim, class Law>
Packing<Dim> ExplicitDynamics<Dim, Law>::packing() const {
  Packing<Dim> out = origin_;
  out.cell.matrix = side_.asDiagonal();
  out.cell.velocity = side_rate_.asDiagonal();
  std::vector<Vec<Dim, int>> wrap(grains_.size());
  for (int k = 0; k < grains_.size(); ++k) {
    const int i = grains_.index[k];
    for (int a = 0; a < Dim; ++a) {
      const double turns = std::floor(grains_.x[a][k] / side_[a]);
      wrap[k][a] = -static_cast<int>(turns);
      out.grains.position[i][a] = grains_.x[a][k] - turns * side_[a];
      out.grains.velocity[i][a] = grains_.v[a][k];
    }
    for (int a = 0; a < kRotations<Dim>; ++a) out.grains.angular_velocity[i][a] = grains_.spin[a][k];
    out.grains.orientation[i] = grains_.angle[k];
  }
  for (int p = 0; p < pairs_.size(); ++p) {
    NeighborPair<Dim> key = pairs_.key[p];
    Vec<Dim> r;
    for (int a = 0; a < Dim; ++a)
      r[a] = grains_.x[a][key.j] - grains_.x[a][key.i] + pairs_.image[a][p] * side_[a];
    if (r.squaredNorm() >= pairs_.reach_squared[p]) continue;
    ContactHistory<Law, Dim> history = pairs_.history[p];
    key = {grains_.index[key.i], grains_.index[key.j], key.image + wrap[key.i] - wrap[key.j]};
    if (key.j < key.i) {
      key = swapped(key);
      swap_sides<Law>(history);
    }
    Contact<Dim> c;
    c.i = key.i;
    c.j = key.j;
    c.image = key.image;
    if constexpr (Law::kHasFriction) c.shear_spring = history.shear;
    if constexpr (Law::kHasRolling) c.rolling_spring = history.roll;
    out.contacts.push_back(c);
  }
  std::sort(out.contacts.begin(), out.contacts.end(), [](const Contact<Dim>& p, const Contact<Dim>& q) {
    return before<Dim>({p.i, p.j, p.image}, {q.i, q.j, q.image});
  });
  refresh_contacts(out);
  return out;
}

template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>& packing, const CellControl<Dim>& control,
                                             const DynamicsSettings& settings) {
  return std::visit(
      [&]<class Law>(const Law& law) -> std::unique_ptr<Dynamics<Dim>> {
        return std::make_unique<ExplicitDynamics<Dim, Law>>(packing, law, control, settings);
      },
      compose_law(packing.law));
}

template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times) {
  const Grains<Dim>& g = packing.grains;
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < g.size(); ++i) {
    shortest = std::min(shortest, std::sqrt(g.mass[i] / packing.law.normal_stiffness));
    // Rolling is stable to 1.7 times the step in units of its own period that vibration allows (measured).
    if (packing.law.rolling)
      shortest = std::min(shortest, 1.7 * std::sqrt(g.inertia(i) / packing.law.rolling->stiffness));
  }
  return time_step_in_contact_times * shortest;
}

template std::unique_ptr<Dynamics<2>> make_dynamics(const Packing<2>&, const CellControl<2>&,
                                                    const DynamicsSettings&);
template double time_step_of(const Packing<2>&, double);

}  // namespace floc
