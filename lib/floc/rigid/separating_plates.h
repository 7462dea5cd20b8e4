#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/rigid/gap_curvature.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// The contacts of grains with corners, without friction and adhesion, in a time step that is solved at once
/// (implicit_step.h), in a form that does not depend on the features that are closest. Two convex bodies do not overlap if
/// and only if a plane separates them. A light plate between the grains of each pair therefore moves and turns freely, and
/// each vertex that is close to the plate stays on its side of it.
///
/// The points of a manifold (manifold.h) hold for the features that are closest at the start of a step. Two faces that
/// are nearly parallel are closest at one of their corners, and at another one after the step, so that such steps do
/// not converge. A step with plates knows all corners.
class SeparatingPlates {
 public:
  /// Velocities of gaps over the gaps (1/time): of the largest closing of an open gap, and of the opening of an overlap.
  struct Rates {
    double closing, opening;
  };

  /// @param packing   packing at the start of the step
  /// @param bodies    motion of its bodies without contacts
  /// @param contacts  contacts of the step; those of one pair of bodies follow each other
  /// @param gaps      gap of each contact (length)
  /// @param reach     distance from a plate up to which vertices take part (length)
  SeparatingPlates(const Packing<3>& packing, const BodyMotion<3>& bodies,
                   const std::vector<StepContact<3>>& contacts, const std::vector<double>& gaps, double reach,
                   const Rates& rates);

  /// Solves the step: first without the turns of forces, then with the turns of the forces found.
  /// @param bodies    get the velocities at the end of the step
  /// @param contacts  the contacts of the constructor, which get the impulses
  /// @return whether both programs were solved; otherwise nothing is changed
  bool solve(double dt, BodyMotion<3>& bodies, std::vector<StepContact<3>>& contacts);

 private:
  /// A pair of bodies.
  struct Pair {
    bool has_wall;
    int first, last;  ///< range of its contacts in the contacts of the step
    int begin, end;   ///< range in contacts_, with a wall or of the second grain with its plate
  };

  int add_plate(const StepContact<3>& contact, const Vec<3>& centre);
  void add_vertices(const PlacedShape<3>& grain, StepContact<3> pattern, bool is_second, const Vec<3>& centre,
                    double impulse);
  std::vector<PairMatrix<3>> stiffnesses(double dt) const;
  PairMatrix<3> gap_curvature_at(const StepContact<3>& contact) const;
  void share_impulse(const Pair& pair, std::vector<StepContact<3>>& contacts) const;

  int n_bodies_;
  std::vector<double> gaps_;
  double reach_;
  Rates rates_;
  BodyMotion<3> motion_;                  ///< motion of the bodies, followed by the plates
  std::vector<StepContact<3>> contacts_;  ///< contacts with plates and walls
  std::vector<Pair> pairs_;
};

}  // namespace floc
