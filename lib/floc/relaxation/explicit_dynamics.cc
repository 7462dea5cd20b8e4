#include "floc/relaxation/explicit_dynamics.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "floc/contact/law_table.h"
#include "floc/neighbors/space_order.h"
#include "floc/packing/contact_forces.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/barrier.h"

namespace floc {
namespace {

/// What a new list of pairs costs, in time steps (measured at N = 1400 and 100 000).
constexpr double kListCost = 23.0;
constexpr double kThinnestSkin = 1e-3;  // of the largest diameter, or the smallest where they differ much

}  // namespace

template <int Dim>
ExplicitDynamics<Dim>::ExplicitDynamics(const Packing<Dim>& packing, const CellControl<Dim>& control,
                                        const DynamicsSettings& settings)
    : parameters_(packing.law),
      law_(compose_law(packing.law)),
      composed_law_(std::visit([](const auto& law) { return static_cast<const void*>(&law); }, law_)),
      range_(packing.law.range()),
      kernels_(step_kernels(settings.instructions, law_.index())),
      control_(control),
      dt_(settings.time_step),
      skin_(settings.skin),
      threads_(settings.threads),
      largest_(largest_diameter(packing.grains)),
      thinnest_skin_(kThinnestSkin * size_of_skins(packing.grains.radius)),
      grains_(packing.grains, space_order(packing.cell, packing.grains)),
      side_(packing.cell.matrix.diagonal()),
      side_rate_(packing.cell.velocity.diagonal()),
      strain_rate_(side_rate_.cwiseQuotient(side_)) {
  sums_.resize(n_blocks());
  rebuild_list();
  load_histories(packing);
  refresh_forces();
}

template <int Dim>
void ExplicitDynamics<Dim>::load_histories(const Packing<Dim>& packing) {
  std::vector<int> place(grains_.size());
  for (int k = 0; k < grains_.size(); ++k) place[grains_.index[k]] = k;
  for (const Contact<Dim>& c : packing.contacts) {
    NeighborPair<Dim> key{place[c.i], place[c.j], c.image};
    // In 2D the tangential spring looks the same from both grains, the relative rotation changes sign.
    const bool swap = key.j < key.i;
    const int p = pairs_.find(swap ? swapped(key) : key);
    if (p < 0) continue;
    if (!pairs_.shear.empty()) pairs_.shear[p] = c.shear_spring[0];
    if (!pairs_.roll.empty()) pairs_.roll[p] = swap ? -c.rolling_spring[0] : c.rolling_spring[0];
  }
}

template <int Dim>
void ExplicitDynamics<Dim>::advance(int n_steps, Motion motion) {
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
      if (list_is_stale()) {
        barrier.wait();  // all have looked before the list changes
        if (thread == 0) rebuild_list();
        barrier.wait();
      }
      if (threads == 1) {
        // Pairs belong to their lower grain: a block's rows stand in it and in those before it, still in the cache.
        for (int b = first; b < last; ++b) compute_pairs(b, dt_), sum_and_kick(b, 0.5 * dt_);
      } else {
        for (int b = first; b < last; ++b) compute_pairs(b, dt_);
        barrier.wait();
        for (int b = first; b < last; ++b) sum_and_kick(b, 0.5 * dt_);
        barrier.wait();
      }
      if (thread == 0) end_step(motion);
    }
  }
}

/// Half a step of acceleration of the sides: M L'' = (work - A Sigma)/L, the rate capped.
template <int Dim>
void ExplicitDynamics<Dim>::kick_cell() {
  if (control_.fixed) return;
  Vec<Dim> work = Vec<Dim>::Zero();
  for (const BlockSums<Dim>& s : sums_)
    for (int a = 0; a < Dim; ++a) work[a] += s.virial[a] + s.momentum_flux[a];
  const Vec<Dim> pull = work - side_.prod() * control_.target;
  side_rate_ += 0.5 * dt_ / control_.mass * pull.cwiseQuotient(side_);
  const Vec<Dim> limit = control_.rate_cap * side_;
  side_rate_ = side_rate_.cwiseMin(limit).cwiseMax(-limit);
}

/// Half kick of the cell, and how this step's drift deforms it. In reduced coordinates s' = v/L with L at mid-step,
/// which keeps the scheme symmetric in time.
template <int Dim>
void ExplicitDynamics<Dim>::begin_step() {
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

template <int Dim>
Kick<Dim> ExplicitDynamics<Dim>::kick_over(double half_step) const {
  // v' = F/m - (L'/L) v, the second term taken at the middle of the half step.
  Kick<Dim> kick{half_step, {}, {}};
  for (int a = 0; a < Dim; ++a) {
    const double drag = 0.5 * half_step * strain_rate_[a];
    kick.gain[a] = 1.0 / (1.0 + drag);
    kick.keep[a] = (1.0 - drag) * kick.gain[a];
  }
  return kick;
}

template <int Dim>
void ExplicitDynamics<Dim>::kick_and_drift(int block) {
  Drift<Dim> drift{dt_, {}, {}, {}};
  for (int a = 0; a < Dim; ++a) {
    drift.stretch[a] = stretch_[a];
    drift.drift[a] = drift_[a];
    drift.list_stretch[a] = list_stretch_[a];
  }
  kernels_.kick_and_drift(grain_arrays_, block * kGrainBlock, kick_over(0.5 * dt_), drift, sums_[block]);
}

/// The share of the time that the list has cost so far, against that of the pairs which it carries for nothing: the skin
/// is right where they are of one size.
template <int Dim>
double ExplicitDynamics<Dim>::list_cost_share() const {
  return kListCost / steps_since_list_;
}

/// What motion has taken of the skin since the list was built: the affine shrinking, and twice the largest displacement
/// relative to it.
template <int Dim>
double ExplicitDynamics<Dim>::eaten_skin() const {
  double squared = 0.0;
  for (const BlockSums<Dim>& s : sums_) squared = std::max(squared, s.displacement_squared);
  const double shrink = std::max(0.0, 1.0 - list_stretch_.minCoeff());
  return 2.0 * std::sqrt(squared) + shrink * (largest_ + range_ + skin_);
}

/// The list carries too many idle pairs, or something outside it might interact.
template <int Dim>
bool ExplicitDynamics<Dim>::list_is_stale() const {
  if (list_cost_share() < 0.5 * idle_share_ && skin_ > thinnest_skin_) return true;
  return eaten_skin() >= skin_;
}

template <int Dim>
void ExplicitDynamics<Dim>::adapt_skin() {
  if (pairs_.size() == 0 || steps_since_list_ == 0) return;
  on_first_list_ = false;
  const double cost = list_cost_share();
  if (cost > idle_share_) skin_ = std::min((cost > 4.0 * idle_share_ ? 2.0 : 1.25) * skin_, 0.5 * largest_);
  if (cost < 0.5 * idle_share_) skin_ = std::max(0.8 * skin_, thinnest_skin_);
}

/// The next stretch begins with a new list in any case: where one list has served for all of this one, twice what motion took
/// of its skin is enough.
template <int Dim>
double ExplicitDynamics<Dim>::skin() const {
  if (!on_first_list_ || steps_since_list_ == 0) return skin_;
  return std::min(skin_, std::max(2.0 * eaten_skin(), thinnest_skin_));
}

/// Share of a step that goes into pairs out of each other's range: a grain costs about as much as a pair.
template <int Dim>
double ExplicitDynamics<Dim>::share_of_idle(const std::vector<NeighborPair<Dim>>& pairs) const {
  std::size_t idle = 0;
  for (const NeighborPair<Dim>& p : pairs) {
    double squared = 0.0;
    for (int a = 0; a < Dim; ++a) {
      const double r = grains_.x[a][p.j] - grains_.x[a][p.i] + p.image[a] * side_[a];
      squared += r * r;
    }
    const double reach = grains_.radius[p.i] + grains_.radius[p.j] + range_;
    idle += squared >= reach * reach;
  }
  return static_cast<double>(idle) /
         static_cast<double>(pairs.size() + static_cast<std::size_t>(grains_.size()));
}

template <int Dim>
void ExplicitDynamics<Dim>::rebuild_list() {
  if (!finite()) return;  // the caller will ask; there are no neighbours to find
  adapt_skin();
  Grains<Dim> now = Grains<Dim>::with_size(grains_.size());
  grains_.copy_positions_to(now);
  now.radius.assign(grains_.radius.begin(), grains_.radius.begin() + grains_.size());
  Cell<Dim> cell;
  cell.matrix = side_.asDiagonal();
  const std::vector<NeighborPair<Dim>> close = find_pairs(cell, now, range_ + skin_);
  idle_share_ = share_of_idle(close);
  HotPairs<Dim> pairs(close, now.radius, grains_.mass, law_, dt_);
  pairs.inherit(pairs_);
  pairs_ = std::move(pairs);
  pair_arrays_ = pairs_.arrays();
  x_list_ = grains_.x;
  grain_arrays_ = grains_.arrays(x_list_);
  side_list_ = side_;
  list_stretch_.setOnes();
  steps_since_list_ = 0;
}

template <int Dim>
PairCell<Dim> ExplicitDynamics<Dim>::pair_cell(double slip_time) const {
  PairCell<Dim> cell{{}, {}, slip_time};
  for (int a = 0; a < Dim; ++a) {
    cell.side[a] = side_[a];
    cell.strain_rate[a] = strain_rate_[a];
  }
  return cell;
}

template <int Dim>
void ExplicitDynamics<Dim>::compute_pairs(int block, double slip_time) {
  kernels_.compute_pairs(composed_law_, grain_arrays_, pair_arrays_, pairs_.first_of_block(block),
                         pairs_.first_of_block(block + 1), pair_cell(slip_time));
}

template <int Dim>
void ExplicitDynamics<Dim>::sum_and_kick(int block, double half_step) {
  kernels_.sum_and_kick(grain_arrays_, pair_arrays_, pairs_.plan(block), block * kGrainBlock, pair_cell(0.0),
                        kick_over(half_step), sums_[block]);
}

template <int Dim>
void ExplicitDynamics<Dim>::end_step(Motion motion) {
  kick_cell();
  if (motion != Motion::power_control) return;
  double twice_kinetic = 0.0;
  for (const BlockSums<Dim>& s : sums_) {
    for (const double flux : s.momentum_flux) twice_kinetic += flux;
    twice_kinetic += s.rotation;
  }
  if (!control_.fixed) twice_kinetic += control_.mass * side_rate_.squaredNorm();
  if (twice_kinetic < kinetic_) {
    for (auto& component : grains_.v) std::fill(component.begin(), component.end(), 0.0);
    for (auto& component : grains_.spin) std::fill(component.begin(), component.end(), 0.0);
    for (BlockSums<Dim>& s : sums_) {
      std::fill(std::begin(s.momentum_flux), std::end(s.momentum_flux), 0.0);
      s.rotation = 0.0;
    }
    side_rate_.setZero();
    twice_kinetic = 0.0;
  }
  kinetic_ = twice_kinetic;
}

/// Forces of the present positions and velocities, histories untouched but for their caps.
template <int Dim>
void ExplicitDynamics<Dim>::refresh_forces() {
  for (int b = 0; b < n_blocks(); ++b) compute_pairs(b, 0.0);
  for (int b = 0; b < n_blocks(); ++b) sum_and_kick(b, 0.0);
}

template <int Dim>
bool ExplicitDynamics<Dim>::finite() const {
  bool all = side_.allFinite() && side_rate_.allFinite();
  for (const auto& component : grains_.x)
    for (const double x : component) all = all && std::isfinite(x);
  return all;
}

template <int Dim>
Packing<Dim> ExplicitDynamics<Dim>::packing() const {
  Packing<Dim> out;
  out.law = parameters_;
  out.grains =
      Grains<Dim>::with_size(grains_.size());  // centres in one part: motion ends at the rounding of that
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
    out.grains.radius[i] = grains_.radius[k];
    out.grains.mass[i] = grains_.mass[k];
  }
  out.contacts.reserve(pairs_.size());
  for (int p = 0; p < pairs_.size(); ++p) {
    if (pairs_.padding(p)) continue;
    NeighborPair<Dim> key = pairs_.key(p);
    Vec<Dim> r;
    for (int a = 0; a < Dim; ++a) r[a] = grains_.x[a][key.j] - grains_.x[a][key.i] + key.image[a] * side_[a];
    const double reach = pairs_.radii(p) + range_;
    if (r.squaredNorm() >= reach * reach) continue;
    key = {grains_.index[key.i], grains_.index[key.j], key.image + wrap[key.i] - wrap[key.j]};
    const bool swap = key.j < key.i;
    if (swap) key = swapped(key);
    Contact<Dim> c;
    c.i = key.i;
    c.j = key.j;
    c.image = key.image;
    if (!pairs_.shear.empty()) c.shear_spring[0] = pairs_.shear[p];
    if (!pairs_.roll.empty()) c.rolling_spring[0] = swap ? -pairs_.roll[p] : pairs_.roll[p];
    out.contacts.push_back(c);
  }
  std::sort(out.contacts.begin(), out.contacts.end(), precedes<Contact<Dim>>);
  refresh_contacts(out);
  return out;
}

template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>& packing, const CellControl<Dim>& control,
                                             const DynamicsSettings& settings) {
  return std::make_unique<ExplicitDynamics<Dim>>(packing, control, settings);
}

template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times) {
  const Grains<Dim>& g = packing.grains;
  double shortest = std::numeric_limits<double>::infinity();
  // Springs across the contact vibrate faster than those along it where they are stiffer.
  const double stiffest =
      std::max(packing.law.normal_stiffness, packing.law.friction ? packing.law.friction->stiffness : 0.0);
  for (int i = 0; i < g.size(); ++i) {
    shortest = std::min(shortest, std::sqrt(g.mass[i] / stiffest));
    // Rolling is stable to 1.45 times the step in units of its own period that vibration allows (measured in crystals).
    if (packing.law.rolling)
      shortest = std::min(shortest, 1.45 * std::sqrt(g.inertia(i) / packing.law.rolling->stiffness));
  }
  return time_step_in_contact_times * shortest;
}

template std::unique_ptr<Dynamics<2>> make_dynamics(const Packing<2>&, const CellControl<2>&,
                                                    const DynamicsSettings&);
template double time_step_of(const Packing<2>&, double);

}  // namespace floc
