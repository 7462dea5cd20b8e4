#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "floc/base/aligned_vector.h"
#include "floc/base/shared_loops.h"
#include "floc/rigid/contact_colours.h"
#include "floc/rigid/contact_lanes.h"
#include "floc/rigid/gauss_seidel.h"
#include "floc/rigid/kernels/sweep_kernels.h"

namespace floc {

/// Interface of the sweeps of GaussSeidel over the contacts of one time step. It does not depend on the type of the
/// groups in which the contacts are stored.
template <int Dim>
class ContactSweeps {
 public:
  virtual ~ContactSweeps() = default;
  virtual int n_colours() const = 0;
  virtual SweepResult solve(double tolerance, int max_sweeps, int check_every) = 0;
  virtual double residual() const = 0;
};

/// Sweeps of a team of threads over groups of contacts (kernels/contact_groups.h).
///
/// Contacts are solved colour by colour. The contacts of a colour are divided into groups, and the groups into chunks.
/// The size of the chunks does not depend on the number of threads. A sum over contacts is computed for each chunk, and
/// these sums are added in the order of the chunks, so results are bitwise identical for any number of threads.
template <class Group>
class TeamSweeps final : public ContactSweeps<Group::kDim> {
 public:
  static constexpr int Dim = Group::kDim;

  TeamSweeps(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, const std::vector<bool>& moving,
             ContactColours colours, int threads, InstructionSet instructions)
      : bodies_(bodies),
        contacts_(contacts),
        kernels_(sweep_kernels<Group>(instructions)),
        colours_(std::move(colours)),
        free_(bodies) {
    for (const int k : colours_.contacts)
      push(contacts[k], Vec<Dim>(-contacts[k].adhesion * Vec<Dim>::Unit(0)), free_);
    make_groups(moving);
    divide(threads);
    rows_.assign(kRow * (bodies.size() + 1), 0.0);
    recompute_motion();
    start_.reserve(kMotion * bodies.size());
    for (int i = 0; i < bodies.size(); ++i)
      start_.insert(start_.end(), rows_.begin() + kRow * i, rows_.begin() + kRow * i + kMotion);
    earlier_start_ = start_;
    start_stretch_ = earlier_start_stretch_ = stretch_;
  }

  int n_colours() const override { return colours_.n_colours(); }

  SweepResult solve(double tolerance, int max_sweeps, int check_every) override {
    SweepResult out;
    last_change_ = 0.0;
    for (GroupSums& sums : sums_) sums.change = 0.0;
    SharedLoops::run(n_threads_, [&](SharedLoops& loops) {
      bool rounded = false;
      while (true) {
        const bool last = out.n_sweeps >= max_sweeps;
        if (out.n_sweeps % check_every == 0 || last) {
          out.residual = residual(loops);
          if (rounded && (out.residual < tolerance || last)) {
            recompute_motion();
            rounded = false;
            out.residual = residual(loops);
          }
          out.converged = out.residual < tolerance;
          if (out.converged || last) return;
        }
        sweep(loops, out.n_sweeps % kAllEvery == 0);
        rounded = true;
        ++out.n_sweeps;
      }
    });
    write_back();
    return out;
  }

  double residual() const override {
    std::vector<GroupErrors> errors;
    for (const Chunk& chunk : chunks_) errors.push_back(errors_of(chunk));
    return relative(errors);
  }

 private:
  /// Consecutive groups of one colour: the groups with the indices begin to end - 1.
  struct Chunk {
    int begin, end;
  };

  static constexpr int kRow = BodyRow<Dim>::kSize, kMotion = BodyRow<Dim>::kMotion;
  /// Each sweep whose number is a multiple of kAllEvery goes over all groups. All other sweeps leave out the idle
  /// groups: those whose impulses were zero at the end of the last sweep over all groups, at its start, and at the start
  /// of the sweep before. Most contacts of these groups have open gaps.
  static constexpr int kAllEvery = 10;
  /// Number of groups per chunk.
  static constexpr int kChunk = 8;
  /// A contact counts as sticking if its tangential impulse, divided by Coulomb's limit, is below this number.
  static constexpr double kBelowLimit = 1.0 - 1e-6;
  /// Number of bodies per chunk.
  static constexpr int kBodyChunk = 512;
  /// Several threads solve a colour only if it has at least this number of chunks. With fewer chunks, the time lost by
  /// waiting for other threads would be as long as the time saved.
  static constexpr int kSharedChunks = 4;

  /// Adds the impulse of a contact, in the frame of the contact, to the motion of the bodies and of the cell.
  static void push(const StepContact<Dim>& c, const Vec<Dim>& impulse, BodyMotion<Dim>& bodies) {
    const Vec<Dim> in_space = c.frame * impulse;
    bodies.velocity[c.i] -= bodies.inverse_mass[c.i].cwiseProduct(in_space);
    bodies.angular_velocity[c.i] -= bodies.inverse_inertia[c.i] * moment<double>(c.arm_i, in_space);
    bodies.velocity[c.j] += bodies.inverse_mass[c.j].cwiseProduct(in_space);
    bodies.angular_velocity[c.j] += bodies.inverse_inertia[c.j] * moment<double>(c.arm_j, in_space);
    bodies.stretch += bodies.inverse_stretch_mass.cwiseProduct(c.branch.cwiseProduct(in_space));
  }

  /// States of a contact, in the order in which contacts are sorted into groups.
  enum State { sticking, sliding, open };

  /// Returns the state of a contact according to its present impulse.
  static State state_of(const StepContact<Dim>& c) {
    if (!(c.impulse[0] > 0.0)) return open;
    const double tangential = c.impulse.template tail<Dim - 1>().norm();
    return tangential < kBelowLimit * c.friction * c.impulse[0] ? sticking : sliding;
  }

  /// Sorts the contacts of each colour into groups of contacts with equal states. Sliding contacts in 3D take more time
  /// than others; groups of open contacts are soon idle.
  void make_groups(const std::vector<bool>& moving) {
    place_.resize(colours_.contacts.size());
    const Group empty = empty_group();
    for (int c = 0; c < n_colours(); ++c) {
      first_group_.push_back(static_cast<int>(groups_.size()));
      const int begin = colours_.start[c], end = colours_.start[c + 1];
      std::stable_sort(colours_.contacts.begin() + begin, colours_.contacts.begin() + end,
                       [&](int k, int l) { return state_of(contacts_[k]) < state_of(contacts_[l]); });
      // The contacts of the last possible colour may share bodies, and each of them is a group of its own.
      const int size = c == kMostColours - 1 ? 1 : kGroup;
      for (int n = begin; n < end; ++n) {
        const int lane = (n - begin) % size;
        if (lane == 0) groups_.push_back(empty);
        const StepContact<Dim>& contact = contacts_[colours_.contacts[n]];
        Group& group = groups_.back();
        set_contact(group, lane, bodies_, contact, end - begin);
        group.moves_i[lane] = moving[contact.i];
        group.moves_j[lane] = moving[contact.j];
        place_[n] = {static_cast<int>(groups_.size()) - 1, lane};
      }
    }
    first_group_.push_back(static_cast<int>(groups_.size()));
  }

  /// Returns a group whose contacts are between a body that does not move, the one after the last body, and itself.
  Group empty_group() const {
    BodyMotion<Dim> bodies;
    bodies.velocity = {Vec<Dim>::Zero()};
    bodies.angular_velocity = {RotationVector<Dim>::Zero()};
    bodies.inverse_mass = {Vec<Dim>::Ones()};
    bodies.inverse_inertia = {Mat<kRotations<Dim>>::Zero()};
    StepContact<Dim> contact{};
    Group out{};
    for (int lane = 0; lane < kGroup; ++lane) {
      set_contact(out, lane, bodies, contact, 1);
      out.i[lane] = out.j[lane] = bodies_.size();
    }
    out.touches_itself = false;
    return out;
  }

  void divide(int threads) {
    int most_chunks = 1;
    for (int c = 0; c < n_colours(); ++c) {
      first_chunk_.push_back(static_cast<int>(chunks_.size()));
      for (int g = first_group_[c]; g < first_group_[c + 1]; g += kChunk)
        chunks_.push_back({g, std::min(g + kChunk, first_group_[c + 1])});
      if (is_shared(c)) most_chunks = std::max(most_chunks, n_chunks(c));
    }
    first_chunk_.push_back(static_cast<int>(chunks_.size()));
    n_threads_ = std::min(threads, most_chunks);
    sums_.resize(chunks_.size());
    errors_.resize(chunks_.size());
  }
  int n_chunks(int colour) const {
    return (first_group_[colour + 1] - first_group_[colour] + kChunk - 1) / kChunk;
  }
  bool is_shared(int colour) const { return n_chunks(colour) >= kSharedChunks && colour != kMostColours - 1; }

  /// Recomputes the motion from the impulses, since it collects rounding errors during many sweeps.
  void recompute_motion() {
    BodyMotion<Dim> motion = free_;
    for (std::size_t n = 0; n < place_.size(); ++n) {
      const StepContact<Dim>& contact = contacts_[colours_.contacts[n]];
      push(contact, impulse_of(n), motion);
    }
    for (int i = 0; i < motion.size(); ++i) set_row(motion, i, &rows_[kRow * i]);
    stretch_ = motion.stretch;
  }

  Vec<Dim> impulse_of(std::size_t n) const {
    return impulse_in_frame(groups_[place_[n].group], place_[n].lane, contacts_[colours_.contacts[n]].frame);
  }

  void sweep(SharedLoops& loops, bool over_all) {
    const double share = share_of_change();
    extrapolate(loops, share);
    for (int c = 0; c < n_colours(); ++c) {
      const SweepStart start{stretch_.data(), share, over_all};
      const auto solve_chunk = [&](int k) {
        const Chunk& chunk = chunks_[first_chunk_[c] + k];
        kernels_.solve(&groups_[chunk.begin], chunk.end - chunk.begin, rows_.data(), start,
                       sums_[first_chunk_[c] + k]);
      };
      if (is_shared(c))
        loops.for_each(n_chunks(c), solve_chunk);
      else
        for (int k = 0; k < n_chunks(c); ++k) solve_chunk(k);
      for (int k = first_chunk_[c]; k < first_chunk_[c + 1]; ++k)
        for (int a = 0; a < Dim; ++a) stretch_[a] += bodies_.inverse_stretch_mass[a] * sums_[k].gain[a];
    }
  }

  /// Returns the share b of the last change that is added to all impulses before the next sweep, as in the method of
  /// conjugate gradients (Silcowitz-Hansen et al. 2010). Let y_t be the impulses at the start of sweep t, and p_t those
  /// at its end. The next sweep starts from
  ///     y_(t+1) = p_t + b (y_t - y_(t-1)),      b = |p_t - y_t|^2/|p_(t-1) - y_(t-1)|^2,
  /// or from p_t if this b is 1 or larger.
  double share_of_change() {
    double change = 0.0;
    for (const GroupSums& sums : sums_) change += sums.change;
    const double share = change < last_change_ ? change / last_change_ : 0.0;
    last_change_ = change;
    return share;
  }

  /// Extrapolates the motion of all bodies and the rate of stretch. They are linear in the impulses, so they are
  /// extrapolated by the same equation. The impulses themselves are extrapolated when their contact is solved.
  void extrapolate(SharedLoops& loops, double share) {
    const int n = bodies_.size();
    const auto extrapolate_chunk = [&](int k) {
      const int first = k * kBodyChunk;
      kernels_.extrapolate(rows_.data() + kRow * first, start_.data() + kMotion * first,
                           earlier_start_.data() + kMotion * first, std::min(kBodyChunk, n - first), share);
    };
    loops.for_each((n + kBodyChunk - 1) / kBodyChunk, extrapolate_chunk);
    const Vec<Dim> stretch = stretch_ + share * (start_stretch_ - earlier_start_stretch_);
    earlier_start_stretch_ = start_stretch_;
    start_stretch_ = stretch_ = stretch;
  }

  GroupErrors errors_of(const Chunk& chunk) const {
    return kernels_.errors(&groups_[chunk.begin], chunk.end - chunk.begin, rows_.data(), stretch_.data());
  }

  double residual(SharedLoops& loops) {
    loops.for_each(static_cast<int>(chunks_.size()), [&](int k) { errors_[k] = errors_of(chunks_[k]); });
    return relative(errors_);
  }

  /// Returns the largest error divided by the mean of the nonzero normal impulses; infinite if there are errors but no
  /// impulses.
  static double relative(const std::vector<GroupErrors>& errors) {
    GroupErrors all{0.0, 0.0, 0.0};
    for (const GroupErrors& error : errors)
      all = {std::max(all.worst, error.worst), all.sum + error.sum, all.n + error.n};
    if (all.worst == 0.0) return 0.0;
    return all.sum > 0.0 ? all.worst * all.n / all.sum : std::numeric_limits<double>::infinity();
  }

  void write_back() {
    for (int i = 0; i < bodies_.size(); ++i) {
      const double* const row = &rows_[kRow * i];
      bodies_.velocity[i] = Eigen::Map<const Vec<Dim>>(row + BodyRow<Dim>::kVelocity);
      bodies_.angular_velocity[i] = Eigen::Map<const RotationVector<Dim>>(row + BodyRow<Dim>::kSpin);
    }
    bodies_.stretch = stretch_;
    for (std::size_t n = 0; n < place_.size(); ++n) contacts_[colours_.contacts[n]].impulse = impulse_of(n);
  }

  /// Place of a contact: its group and its number in the group.
  struct Place {
    int group, lane;
  };

  BodyMotion<Dim>& bodies_;
  std::vector<StepContact<Dim>>& contacts_;
  const SweepKernels<Group>& kernels_;
  ContactColours colours_;
  BodyMotion<Dim> free_;  // motion that includes the impulses of adhesion, but no other impulses of contacts
  std::vector<Place> place_;  // for each element of colours_.contacts
  AlignedVector<Group> groups_;
  // index of the first group of each colour; the last element is the number of groups
  std::vector<int> first_group_;
  AlignedVector<double> rows_;  // rows of all bodies, followed by the row of a body that does not move
  Vec<Dim> stretch_;            // present rate of stretch of the cell
  std::vector<Chunk> chunks_;
  // index of the first chunk of each colour; the last element is the number of chunks
  std::vector<int> first_chunk_;
  int n_threads_ = 1;
  // Motion of the bodies, and rates of stretch, at the start of the last sweep and of the sweep before.
  AlignedVector<double> start_, earlier_start_;
  Vec<Dim> start_stretch_, earlier_start_stretch_;
  double last_change_ = 0.0;         // value of |p - y|^2 in the sweep before the last sweep
  std::vector<GroupSums> sums_;      // sums of each chunk in the last sweep
  std::vector<GroupErrors> errors_;  // errors of each chunk
};

}  // namespace floc
