#pragma once

#include <memory>
#include <string>

#include "floc/contact/pair_geometry.h"

namespace floc {

struct CapillaryAdhesion;
struct LawParameters;

/// Contact law as packings and runs hold it: a handle to its models and their numbers (law_parameters.h), which
/// are immutable and shared by copies. Its members give the properties that every law has, so that only the
/// sources that evaluate, read or write models have to include them.
class Law {
 public:
  /// Linear repulsion of zero stiffness, a placeholder until a law is assigned.
  Law();
  Law(const LawParameters& parameters);  // NOLINT(google-explicit-constructor): a law is its parameters

  const LawParameters& parameters() const { return *parameters_; }
  operator const LawParameters&() const { return *parameters_; }  // NOLINT(google-explicit-constructor)
  /// Whether two laws have the same models with the same numbers.
  bool operator==(const Law& other) const;

  /// Whether the law has a model of adhesion, or a normal law that includes adhesion.
  bool has_adhesion() const;
  bool has_damping() const;
  bool has_friction() const;
  bool has_rolling() const;
  bool has_twisting() const;

  /// Pull-off force F0 (force) of laws with one value for all pairs; 0 without adhesion and where F0 depends on
  /// the pair.
  double pull_off_force() const;
  /// Pull-off force F0 (force) of two grains of this radius (length); 0 without adhesion.
  double pull_off_force(double radius) const;
  /// Pull-off force F0 (force) of a pair; 0 without adhesion and for liquid bridges, which not every pair has
  /// (packing/liquid/liquid.h).
  double pull_off_force(const PairGeometry<>& pair) const;
  /// Whether grains attract each other.
  bool adheres() const { return pull_off_force(1.0) > 0.0; }
  /// Largest gap (length) at which surfaces that have not met attract each other; 0 if the adhesion has zero
  /// force, and for liquid bridges, whose reach depends on their volumes (packing/liquid/liquid.h).
  double range() const;
  /// Largest gap (length) at which the law acts between grains of at most this radius (length), including
  /// surfaces that have met and still hold together.
  double reach(double largest_radius) const;
  /// Model of liquid bridges; null if the law has none or its water content is zero.
  const CapillaryAdhesion* liquid() const;
  /// Modulus that reduces pressures where nothing adheres: K_N/a^(Dim-2) for linear contacts of grains of
  /// diameter a, E/(1 - nu^2) for Hertz contacts (force/length^(Dim-1)).
  double contact_modulus(int dim, double diameter) const;

  /// Whether the normal force depends on the history of the overlap, and so dissipates energy.
  bool keeps_overlap() const;
  /// Whether the normal law itself includes the adhesion.
  bool adheres_by_itself() const;
  /// Keyword of the normal law.
  const char* normal_keyword() const;
  /// Exponent of the overlap in the elastic force; 1 for contacts of constant stiffness.
  double force_exponent() const;
  /// Whether the normal law holds only for overlaps that are small compared with the grains.
  bool is_for_small_overlaps() const;

  /// Reason why the law cannot be used in this dimension, in words; empty if it can.
  std::string fault_in_dimension(int dimension) const;

  /// Whether friction can carry any force.
  bool resists_sliding() const;
  /// Whether the tangential stiffness depends on the normal force. Tangential forces then depend on the loading
  /// path, even where no contact slides.
  bool friction_follows_load() const;

 private:
  std::shared_ptr<const LawParameters> parameters_;
};

}  // namespace floc
