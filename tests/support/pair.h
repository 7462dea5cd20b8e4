#pragma once

#include "floc/contact/contact_law.h"
#include "floc/contact/history_layout.h"
#include "floc/geometry/frame.h"
#include "support/laws.h"

namespace floc::test {

/// Motion of one grain in one step.
template <int Dim>
struct GrainStep {
  Vec<Dim> displacement = Vec<Dim>::Zero();
  RotationVector<Dim> rotation = RotationVector<Dim>::Zero();
};

/// Two grains in contact with prescribed motion. Their relative motion follows docs/physics.md, "Kinematics of a
/// contact". The lever arm of a grain of radius R is l = R r/(Ri + Rj), with the branch length r. The motion is
/// evaluated in the middle of the step, so that the error is of second order in the step.
template <class Law, int Dim>
class MovingPair {
 public:
  MovingPair(const Law& law, const Vec<Dim>& xi, const Vec<Dim>& xj, double ri, double rj)
      : law_(law), xi_(xi), xj_(xj), ri_(ri), rj_(rj) {}

  /// Moves both grains and returns the forces in the new contact frame.
  ContactForces<Dim> move(const GrainStep<Dim>& i, const GrainStep<Dim>& j) {
    const Vec<Dim> before = xj_ - xi_;
    xi_ += i.displacement;
    xj_ += j.displacement;
    const Vec<Dim> after = xj_ - xi_;
    const Vec<Dim> half = (before + after) / 2;
    const Vec<Dim> n = half.normalized();
    const double arm = half.norm() / (ri_ + rj_);
    const RotationVector<Dim> rotations = ri_ * arm * i.rotation + rj_ * arm * j.rotation;

    ContactMotion<Dim> motion{pair_at(after.norm() - ri_ - rj_), 0.0, 0.0, Shear<Dim>::Zero(),
                              RotationVector<Dim>::Zero()};
    motion.slip = to_shear<double>(n, after - before - cross<double>(rotations, n));
    motion.relative_rotation = rolling_part<double>(n, RotationVector<Dim>(i.rotation - j.rotation));
    double twist = 0.0;
    if constexpr (Dim == 3) {
      twist = 0.5 * (i.rotation + j.rotation).dot(n);
      motion.twist = (i.rotation - j.rotation).dot(n);
    }
    transport_history(before.normalized(), normal(), twist);
    return law_.respond(motion, memory_);
  }

  Vec<Dim> normal() const { return (xj_ - xi_).normalized(); }
  const Vec<Dim>& position_i() const { return xi_; }
  const Vec<Dim>& position_j() const { return xj_; }

 private:
  void transport_history([[maybe_unused]] const Vec<Dim>& from, [[maybe_unused]] const Vec<Dim>& to,
                         [[maybe_unused]] double twist) {
    if constexpr (Dim == 3)
      for (const HistoryQuantity& q : history_quantities(parameters_of(law_), Dim)) {
        if (q.size != 3) continue;
        ContactHistory<Dim> all = unpacked_history<Law, Dim>(memory_);
        all.template segment<3>(q.begin) =
            transport<double>(Vec<3>(all.template segment<3>(q.begin)), from, to, twist);
        memory_ = packed_history<Law, Dim>(all);
      }
  }

  Law law_;
  ContactHistoryOf<Law, Dim> memory_;
  Vec<Dim> xi_, xj_;
  double ri_, rj_;
};

}  // namespace floc::test
