#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "floc/base/aligned_vector.h"
#include "floc/base/shared_loops.h"
#include "floc/rigid/contact_colours.h"
#include "floc/rigid/gauss_seidel.h"

namespace floc {

/// Interface of the sweeps of GaussSeidel over the contacts of one time step. It does not depend on the type of the
/// records in which the contacts are stored.
template <int Dim>
class ContactSweeps {
 public:
  virtual ~ContactSweeps() = default;
  virtual int n_colours() const = 0;
  virtual SweepResult solve(double tolerance, int max_sweeps, int check_every) = 0;
  virtual double residual() const = 0;
};

/// Sweeps of a team of threads over the records of a model (packed_contacts.h).
///
/// Contacts are solved colour by colour. The contacts of a colour are divided into chunks. The size of the chunks does
/// not depend on the number of threads. A sum over contacts is computed for each chunk, and these sums are added in the
/// order of the chunks, so results are bitwise identical for any number of threads.
template <class Model>
class TeamSweeps final : public ContactSweeps<Model::kDim> {
 public:
  static constexpr int Dim = Model::kDim;

  TeamSweeps(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, const std::vector<bool>& moving,
             ContactColours colours, int threads)
      : bodies_(bodies), contacts_(contacts), colours_(std::move(colours)), free_stretch_(bodies.stretch) {
    for (int i = 0; i < bodies.size(); ++i) free_.push_back(Model::pack(bodies, i, moving[i]));
    records_.reserve(colours_.contacts.size());
    Vec<Dim> gain = Vec<Dim>::Zero();
    for (int c = 0; c < n_colours(); ++c)
      for (int k = colours_.start[c]; k < colours_.start[c + 1]; ++k) {
        const StepContact<Dim>& contact = contacts[colours_.contacts[k]];
        records_.push_back(Model::pack(bodies, contact, colours_.start[c + 1] - colours_.start[c]));
        Model::apply(records_.back(), Model::normal_impulse(-contact.adhesion), free_.data(), gain);
      }
    free_stretch_ += bodies.inverse_stretch_mass.cwiseProduct(gain);
    is_idle_.assign(records_.size(), 0);
    direction_.assign(records_.size(), Model::normal_impulse(0.0));
    last_step_ = direction_;
    divide(threads);
    recompute_velocities();
  }

  int n_colours() const override { return colours_.n_colours(); }

  SweepResult solve(double tolerance, int max_sweeps, int check_every) override {
    SweepResult out;
    last_change_ = 0.0;
    SharedLoops::run(n_threads_, [&](SharedLoops& loops) {
      bool rounded = false;
      while (true) {
        const bool last = out.n_sweeps >= max_sweeps;
        if (out.n_sweeps % check_every == 0 || last) {
          out.residual = residual(loops);
          if (rounded && (out.residual < tolerance || last)) {
            recompute_velocities();
            rounded = false;
            out.residual = residual(loops);
          }
          out.converged = out.residual < tolerance;
          if (out.converged || last) return;
        }
        if (out.n_sweeps > 0) extrapolate(loops);
        sweep(loops, out.n_sweeps % kAllEvery == 0);
        rounded = true;
        ++out.n_sweeps;
      }
    });
    write_back();
    return out;
  }

  double residual() const override {
    std::vector<ChunkError> errors;
    for (const Chunk& chunk : chunks_) errors.push_back(error_of(chunk));
    return relative(errors);
  }

 private:
  using Body = typename Model::Body;
  using Contact = typename Model::Contact;
  using Impulse = typename Model::Impulse;

  /// Consecutive contacts of one colour: the contacts with the indices begin to end - 1 in the order of colours.
  struct Chunk {
    int begin, end;
  };
  /// For the contacts of a chunk: the largest contact_error(), the sum of the normal impulses, and the number of
  /// nonzero normal impulses.
  struct ChunkError {
    double worst, sum;
    int n;
  };

  /// Each sweep whose number is a multiple of kAllEvery goes over all contacts. All other sweeps leave out the contacts
  /// whose impulse was zero in the last sweep over all contacts; most of these contacts have open gaps.
  static constexpr int kAllEvery = 10;
  /// Number of contacts per chunk. Solving a chunk takes from 0.4 microseconds (disks) to 4 microseconds (bodies of any
  /// shape in 3D).
  static constexpr int kChunk = 64;
  /// Several threads solve a colour only if it has at least this number of chunks. With fewer chunks, the time lost by
  /// waiting for other threads would be as long as the time saved.
  static constexpr int kSharedChunks = 4;

  void divide(int threads) {
    int most_chunks = 1;
    for (int c = 0; c < n_colours(); ++c) {
      first_chunk_.push_back(static_cast<int>(chunks_.size()));
      for (int k = colours_.start[c]; k < colours_.start[c + 1]; k += kChunk)
        chunks_.push_back({k, std::min(k + kChunk, colours_.start[c + 1])});
      if (is_shared(c)) most_chunks = std::max(most_chunks, n_chunks(c));
    }
    first_chunk_.push_back(static_cast<int>(chunks_.size()));
    n_threads_ = std::min(threads, most_chunks);
    gain_.assign(chunks_.size(), Vec<Dim>::Zero());
    change_.assign(chunks_.size(), 0.0);
    error_.resize(chunks_.size());
  }
  int n_chunks(int colour) const {
    return (colours_.start[colour + 1] - colours_.start[colour] + kChunk - 1) / kChunk;
  }
  bool is_shared(int colour) const { return n_chunks(colour) >= kSharedChunks && colour != kMostColours - 1; }

  /// Recomputes the velocities from the impulses, since the velocities collect rounding errors during many sweeps.
  void recompute_velocities() {
    packed_ = free_;
    Vec<Dim> gain = Vec<Dim>::Zero();
    for (const Contact& record : records_) Model::apply(record, record.impulse, packed_.data(), gain);
    stretch_ = free_stretch_ + bodies_.inverse_stretch_mass.cwiseProduct(gain);
  }

  void sweep(SharedLoops& loops, bool over_all) {
    for (int c = 0; c < n_colours(); ++c) {
      if (is_shared(c))
        loops.for_each(n_chunks(c), [&](int k) { solve_chunk(first_chunk_[c] + k, over_all); });
      else
        for (int k = 0; k < n_chunks(c); ++k) solve_chunk(first_chunk_[c] + k, over_all);
      for (int k = first_chunk_[c]; k < first_chunk_[c + 1]; ++k)
        stretch_ += bodies_.inverse_stretch_mass.cwiseProduct(gain_[k]);
    }
  }

  /// Extrapolates the impulses in the direction of their earlier changes, as the method of conjugate gradients does
  /// (Silcowitz-Hansen et al. 2010). Let r be the change of all impulses in the last sweep, r_old the change in the
  /// previous sweep, d the present direction, and b = |r|^2/|r_old|^2. The impulses change by b d, and the new
  /// direction is b d + r. If b >= 1, the impulses do not change, and the new direction is r.
  void extrapolate(SharedLoops& loops) {
    double change = 0.0;
    for (const double part : change_) change += part;
    const double share = change < last_change_ ? change / last_change_ : 0.0;
    last_change_ = change;
    for (int c = 0; c < n_colours(); ++c) {
      if (is_shared(c))
        loops.for_each(n_chunks(c), [&](int k) { extrapolate_chunk(first_chunk_[c] + k, share); });
      else
        for (int k = 0; k < n_chunks(c); ++k) extrapolate_chunk(first_chunk_[c] + k, share);
      for (int k = first_chunk_[c]; k < first_chunk_[c + 1]; ++k)
        stretch_ += bodies_.inverse_stretch_mass.cwiseProduct(gain_[k]);
    }
  }

  [[gnu::flatten]] void extrapolate_chunk(int chunk, double share) {
    Vec<Dim> gain = Vec<Dim>::Zero();
    const Chunk range = chunks_[chunk];
    for (int k = range.begin; k < range.end; ++k) {
      if (is_idle_[k]) {
        direction_[k] = Model::normal_impulse(0.0);
        continue;
      }
      if (share == 0.0) {
        direction_[k] = last_step_[k];
        continue;
      }
      Contact& record = records_[k];
      const Impulse further = share * direction_[k];
      record.impulse = record.impulse + further;
      Model::apply(record, further, packed_.data(), gain);
      direction_[k] = further + last_step_[k];
    }
    gain_[chunk] = gain;
  }

  // The attribute makes the compiler inline all functions that the loop calls; otherwise vectors would be passed
  // through memory.
  [[gnu::flatten]] void solve_chunk(int chunk, bool over_all) {
    const Vec<Dim> stretch = stretch_;
    Vec<Dim> gain = Vec<Dim>::Zero();
    Body* const bodies = packed_.data();
    const Chunk range = chunks_[chunk];
    double change = 0.0;
    for (int k = range.begin; k < range.end; ++k) {
      if (!over_all && is_idle_[k]) continue;
      const Impulse before = records_[k].impulse;
      Model::solve(records_[k], bodies, stretch, gain);
      last_step_[k] = records_[k].impulse - before;
      change += last_step_[k].squaredNorm();
      if (over_all) is_idle_[k] = !(Model::normal(records_[k]) > 0.0);
    }
    gain_[chunk] = gain;
    change_[chunk] = change;
  }

  [[gnu::flatten]] ChunkError error_of(const Chunk& chunk) const {
    ChunkError out{0.0, 0.0, 0};
    for (int k = chunk.begin; k < chunk.end; ++k) {
      const double normal = Model::normal(records_[k]);
      out.worst = std::max(out.worst, Model::error(records_[k], packed_.data(), stretch_));
      out.sum += normal;
      out.n += normal > 0.0;
    }
    return out;
  }

  double residual(SharedLoops& loops) {
    loops.for_each(static_cast<int>(chunks_.size()), [&](int k) { error_[k] = error_of(chunks_[k]); });
    return relative(error_);
  }

  /// Returns the largest error divided by the mean of the nonzero normal impulses; infinite if there are errors but no
  /// impulses.
  static double relative(const std::vector<ChunkError>& errors) {
    ChunkError all{0.0, 0.0, 0};
    for (const ChunkError& error : errors)
      all = {std::max(all.worst, error.worst), all.sum + error.sum, all.n + error.n};
    if (all.worst == 0.0) return 0.0;
    return all.sum > 0.0 ? all.worst * all.n / all.sum : std::numeric_limits<double>::infinity();
  }

  void write_back() {
    for (int i = 0; i < bodies_.size(); ++i) {
      bodies_.velocity[i] = packed_[i].velocity;
      bodies_.angular_velocity[i] = packed_[i].angular_velocity;
    }
    bodies_.stretch = stretch_;
    for (std::size_t k = 0; k < records_.size(); ++k) {
      StepContact<Dim>& contact = contacts_[colours_.contacts[k]];
      contact.impulse = Model::in_frame(records_[k], contact.frame);
    }
  }

  BodyMotion<Dim>& bodies_;
  std::vector<StepContact<Dim>>& contacts_;
  ContactColours colours_;
  // bodies with velocities that include the impulses of adhesion, but no other impulses of contacts
  AlignedVector<Body> free_;
  // rate of stretch of the cell that includes the impulses of adhesion, but no other impulses of contacts
  Vec<Dim> free_stretch_;
  AlignedVector<Body> packed_;
  AlignedVector<Contact> records_;
  // for each record, whether its impulse was zero in the last sweep over all contacts
  std::vector<std::uint8_t> is_idle_;
  Vec<Dim> stretch_;  // present rate of stretch of the cell
  std::vector<Chunk> chunks_;
  // index of the first chunk of each colour; the last element is the number of chunks
  std::vector<int> first_chunk_;
  int n_threads_ = 1;
  std::vector<Impulse> direction_;  // direction d in extrapolate(), for each record
  std::vector<Impulse> last_step_;  // change r in extrapolate(), for each record
  double last_change_ = 0.0;        // value of |r|^2 in the sweep before the last sweep
  std::vector<double> change_;      // contribution of each chunk to |r|^2 in the last sweep
  std::vector<Vec<Dim>> gain_;      // contribution of each chunk to `gain` in the present sweep
  std::vector<ChunkError> error_;   // error of each chunk
};

}  // namespace floc
