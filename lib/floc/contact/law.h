#pragma once

#include <memory>
#include <string>

#include "floc/contact/pair_geometry.h"

namespace floc {

struct CapillaryAdhesion;
struct LawParameters;

/// Contact law of a packing or a run: a handle to the models of the law and their numbers (law_parameters.h), which are
/// immutable and shared between copies. The member functions return properties that every law has. Only code that
/// evaluates, reads or writes the models has to include the headers of the models.
class Law {
 public:
  /// Creates a law of linear repulsion with zero stiffness, a placeholder until another law is assigned.
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

  /// Returns the pull-off force F0 (force) if it is equal for all pairs of grains; 0 if the law has no adhesion or if
  /// F0 depends on the pair.
  double pull_off_force() const;
  /// Returns the pull-off force F0 (force) of two grains with radius `radius` (length); 0 without adhesion.
  double pull_off_force(double radius) const;
  /// Returns the pull-off force F0 (force) of a pair; 0 without adhesion. The result is also 0 for liquid bridges,
  /// because not every pair has a bridge (packing/liquid/liquid.h).
  double pull_off_force(const PairGeometry<>& pair) const;
  /// Whether grains attract each other.
  bool adheres() const { return pull_off_force(1.0) > 0.0; }
  /// Returns the largest gap (length) at which surfaces that have not touched before attract each other. The result is
  /// 0 if the adhesion has zero force. The result is also 0 for liquid bridges, because the reach of a bridge depends
  /// on the volume of the bridge (packing/liquid/liquid.h).
  double range() const;
  /// Returns the largest gap (length) at which the law acts between grains of at most this radius (length). This
  /// includes gaps at which surfaces still stick together after they have touched.
  double reach(double largest_radius) const;
  /// Returns the model of liquid bridges; null if the law has no model of liquid bridges, or if the bridges cannot
  /// attract (CapillaryAdhesion::acts()).
  const CapillaryAdhesion* liquid() const;
  /// Returns the modulus by which the pressures of grains without adhesion are divided to make them dimensionless
  /// (force/length^(dim-1)). For linear contacts of stiffness K_N between grains of diameter a, the modulus is
  /// K_N/a^(dim-2). For Hertz contacts with Young's modulus E and Poisson's ratio nu, the modulus is E/(1 - nu^2).
  double contact_modulus(int dim, double diameter) const;

  /// Whether the contacts are rigid: surfaces do not overlap, and contact forces are not functions of the geometry.
  bool is_rigid() const;
  /// Whether the normal force depends on earlier overlaps of the contact and therefore dissipates energy.
  bool keeps_overlap() const;
  /// Whether the normal law itself includes the adhesion.
  bool adheres_by_itself() const;
  /// Returns the keyword of the normal law in a scene file, such as "linear".
  const char* normal_keyword() const;
  /// Returns the exponent of the overlap in the formula for the elastic normal force; 1 for contacts of constant
  /// stiffness.
  double force_exponent() const;
  /// Whether the normal law is valid only for overlaps that are small compared with the grains.
  bool is_for_small_overlaps() const;

  /// Returns the reason why the law cannot be used in this dimension (2 or 3); empty if it can be used.
  std::string fault_in_dimension(int dimension) const;

  /// Whether the friction force can differ from zero.
  bool resists_sliding() const;
  /// Friction coefficient mu; 0 without friction.
  double friction_coefficient() const;
  /// Whether the tangential stiffness depends on the normal force. Tangential forces then depend on the loading
  /// path, even where no contact slides.
  bool friction_follows_load() const;

 private:
  std::shared_ptr<const LawParameters> parameters_;
};

}  // namespace floc
