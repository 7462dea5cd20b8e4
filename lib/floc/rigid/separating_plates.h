#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/rigid/gap_curvature.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// Contacts of grains with corners, without friction and adhesion, in a time step that is solved at once
/// (implicit_step.h). The method needs no closest features. It uses a theorem: two convex bodies do not overlap if and
/// only if a plane separates them. Each pair of grains gets a light plate between the grains, which moves and rotates
/// freely; every vertex close to the plate must stay on the side of its grain.
///
/// The contact points of a manifold (manifold.h), by contrast, belong to the closest features at the start of a step.
/// If two faces are nearly parallel, one corner may be closest before the step and another corner after it; such steps
/// do not converge to a state of rest. A step with plates takes all corners into account.
class SeparatingPlates {
 public:
  /// Rates of change of gaps, divided by the gap (1/time): the largest rate at which an open gap may close, and the
  /// rate at which an overlap is removed.
  struct Rates {
    double closing, opening;
  };

  /// @param packing   packing at the start of the step
  /// @param bodies    motion that the bodies of the packing would have without contacts
  /// @param contacts  contacts of the step; the contacts of one pair of bodies are consecutive
  /// @param gaps      gap of each contact (length)
  /// @param reach     distance from a plate up to which vertices get contacts with the plate (length)
  SeparatingPlates(const Packing<3>& packing, const BodyMotion<3>& bodies,
                   const std::vector<StepContact<3>>& contacts, const std::vector<double>& gaps, double reach,
                   const Rates& rates);

  /// Solves the step twice: first with contact forces that do not rotate with the bodies, then with the rotation of the
  /// forces that the first solution gave.
  /// @param bodies    bodies; they get the velocities at the end of the step
  /// @param contacts  contacts given to the constructor; they get the impulses
  /// @return whether both programs were solved; otherwise nothing is changed
  bool solve(double dt, BodyMotion<3>& bodies, std::vector<StepContact<3>>& contacts);

 private:
  /// Pair of two bodies in contact: two grains, or a grain and a wall.
  struct Pair {
    bool has_wall;
    /// index of the first contact of the pair in the contacts of the step, and index after its last contact
    int first, last;
    /// first index and end of a range in contacts_: contacts with the wall, or contacts of the second grain with the
    /// plate
    int begin, end;
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
  BodyMotion<3> motion_;                  ///< motion of the bodies and, after them, of the plates
  std::vector<StepContact<3>> contacts_;  ///< contacts with plates and walls
  std::vector<Pair> pairs_;
};

}  // namespace floc
