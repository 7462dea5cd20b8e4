#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/relaxation_progress.h"
#include "floc/relaxation/relaxer.h"

namespace floc {

/// Progress of a relaxation with soft springs. The rest of the relaxation is determined by the progress and the
/// packing.
struct SoftProgress {
  enum Stage {
    stiff,      ///< the packing has the springs of its contact law
    moving,     ///< the grains rearrange on soft springs
    restoring,  ///< the springs regain their stiffness in a few steps, and each step keeps the forces
  };
  int stage = stiff;
  int level = 0;             ///< number of steps of the stage `restoring` so far
  int n_collapses = 0;       ///< number of collapses so far, for each of which the springs were softened
  double begun_phi = 0.0;    ///< solid fraction at the beginning of the stage `stiff`
  std::int64_t n_steps = 0;  ///< number of time steps of this relaxation so far
  double time = 0.0;         ///< simulated time of this relaxation so far (time)
  /// progress of the Relaxer that is used in the stages `stiff` and `moving`; empty before its first chunk
  std::string relaxation;
};

/// Relaxer of a periodic packing that uses soft springs while the packing collapses. The stiffness of soft springs is
/// divided by RelaxationOptions::softening, and time steps are longer by the square root of this factor
/// (docs/numerics.md, "Soft collapse"). At first, a Relaxer moves the packing towards equilibrium with the springs of
/// the contact law. If the solid fraction changes by more than elastic strains can cause, the springs become soft, and
/// the grains move until they stop. The springs then regain their stiffness, and a Relaxer brings the packing to
/// equilibrium. A packing without contacts moves on soft springs from the start.
///
/// Between two chunks of time steps the packing has its own contact law with full stiffness, together with the overlaps
/// and elongations of the soft springs. The forces in this packing are larger than those of the soft springs by the
/// factor RelaxationOptions::softening.
template <int Dim>
class SoftRelaxer final : public Equilibrator<Dim> {
 public:
  /// @throws InputError if the contact law, the pressure or an imposed length does not allow the softening
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
  Relaxer<Dim> relaxer();
  void keep(Relaxer<Dim> relaxer);
  bool collapses() const;
  void soften();
  RelaxationStatus restore();
  bool come_to_rest();
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

/// Returns the text of SoftRelaxer::progress() for the beginning of a relaxation in which the packing moves on soft
/// springs from the start.
std::string progress_on_soft_springs();

}  // namespace floc
