#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/relaxation_progress.h"
#include "floc/relaxation/relaxer.h"

namespace floc {

/// Progress of a relaxation with soft springs. Together with the packing it determines how the relaxation continues.
struct SoftProgress {
  enum Stage {
    untried,    ///< Newton steps without motion have not been tried yet
    softening,  ///< springs become softer in a few steps, with their forces
    moving,     ///< the grains rearrange on soft springs
    restoring,  ///< springs become stiff again in a few steps, with their forces
    stiff,      ///< the packing comes to rest with the springs of its contact law
  };
  int stage = untried;
  int level = 0;  ///< number of steps of `softening` or `restoring` so far
  int returns =
      0;  ///< number of times that the packing has left the stage `stiff` because it rearranged once more
  std::int64_t n_steps = 0;  ///< number of time steps of this relaxation so far
  double time = 0.0;         ///< simulated time of this relaxation so far (time)
  std::string
      relaxation;  ///< progress of the Relaxer of stage `moving` or `stiff`; empty before its first chunk
};

/// Relaxer of a periodic packing whose grains rearrange on springs that are softer by RelaxationOptions::softening, so
/// that time steps are longer by its square root (docs/numerics.md, "Soft collapse"). If the step is not solved at once
/// by Newton steps, the springs of the packing at rest become softer; the grains move under the new load until they
/// stop; the springs become stiff again; and a Relaxer finishes the equilibrium with the springs of the contact law.
///
/// Between two chunks of time steps the packing has its own contact law, with the overlaps and elongations of the soft
/// springs. Its forces are then larger than those of the soft springs by the softening.
template <int Dim>
class SoftRelaxer final : public Equilibrator<Dim> {
 public:
  /// @throws InputError if the contact law, the pressure or an imposed length forbids the softening
  SoftRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
              const std::string& progress = "");

  RelaxationStatus advance() override;
  void set_observer(MotionObserver<Dim> observer) override { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const override { return packing_; }
  Packing<Dim> release_packing() override { return std::move(packing_); }
  const Mat<Dim>& stress() const override { return stress_; }
  const Vec<Dim>& target_stress() const override { return target_; }
  RelaxationReport report() const override { return report_; }
  std::string progress() const override;

 private:
  int n_levels() const;
  double softening() const;
  double softening_at(int level) const;
  Relaxer<Dim> relaxer();
  void keep(Relaxer<Dim> relaxer);
  RelaxationStatus try_without_motion();
  RelaxationStatus change_level();
  bool come_to_rest(const Vec<Dim>& stress, int n_steps);
  RelaxationStatus move();
  void enter(SoftProgress::Stage stage);

  RelaxationOptions options_;
  Packing<Dim> packing_;
  LoadTarget<Dim> load_;
  SoftProgress progress_;
  Law law_;
  Mat<Dim> stress_;  ///< static stress of the packing with its present springs (force/length^(Dim-1))
  Vec<Dim> target_;
  RelaxationReport report_;
  MotionObserver<Dim> observer_;
};

/// Returns the progress, as text, of a relaxation whose packing moves on soft springs already, at its beginning.
std::string progress_on_soft_springs();

}  // namespace floc
