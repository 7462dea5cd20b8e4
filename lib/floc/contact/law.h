#pragma once

#include <memory>
#include <string>

#include "floc/contact/pair_geometry.h"

namespace floc {

struct CapillaryAdhesion;
struct LawParameters;

/// A contact law as packings and runs hold it: a handle to its models and their numbers (law_parameters.h), which
/// copies share and nobody changes. What follows from any law is asked here, so that the models reach only those
/// sources that evaluate, read or write them.
class Law {
 public:
  /// Linear repulsion without stiffness: a law that is still to be given.
  Law();
  Law(const LawParameters& parameters);  // NOLINT(google-explicit-constructor): a law is its parameters

  const LawParameters& parameters() const { return *parameters_; }
  operator const LawParameters&() const { return *parameters_; }  // NOLINT(google-explicit-constructor)
  /// Same models with the same numbers.
  bool operator==(const Law& other) const;

  /// Whether a model of adhesion is there, or a normal law that adheres by itself.
  bool has_adhesion() const;
  bool has_damping() const;
  bool has_friction() const;
  bool has_rolling() const;
  bool has_twisting() const;

  /// F0 of laws with one value for all pairs; 0 without adhesion and where F0 depends on the pair.
  double pull_off_force() const;
  /// F0 of two grains of this radius, 0 without adhesion.
  double pull_off_force(double radius) const;
  /// F0 of a pair, 0 without adhesion and for liquid bridges, which not every pair has (packing/liquid/liquid.h).
  double pull_off_force(const PairGeometry<>& pair) const;
  /// Whether anything attracts.
  bool adheres() const { return pull_off_force(1.0) > 0.0; }
  /// Largest gap at which surfaces that have not met attract each other; adhesion of zero force acts nowhere. 0 for
  /// liquid bridges, whose reach depends on their volumes (packing/liquid/liquid.h).
  double range() const;
  /// Largest gap at which the law acts between grains of no larger radius than this, also between surfaces that have
  /// met and hold together.
  double reach(double largest_radius) const;
  /// The adhesion of liquid bridges, null where there is none or it has no liquid.
  const CapillaryAdhesion* liquid() const;
  /// Modulus that a pressure is compared with where nothing adheres: K_N/a^(Dim-2) for linear contacts of
  /// grains of diameter a, E/(1 - nu^2) for Hertz contacts (force/length^(Dim-1)).
  double contact_modulus(int dim, double diameter) const;

  /// Whether the normal force depends on the way there, and gives back less energy than it took.
  bool keeps_overlap() const;
  /// Whether the normal law attracts, and no model of adhesion.
  bool adheres_by_itself() const;
  /// Keyword of the normal law.
  const char* normal_keyword() const;
  /// Power of the overlap that the elastic force grows with. 1: the stiffness of a contact is a constant.
  double force_exponent() const;
  /// Whether the normal law holds for overlaps that are small beside the grains alone.
  bool is_for_small_overlaps() const;

  /// Why it is no law for this dimension, in words; empty if it is one.
  std::string fault_in_dimension(int dimension) const;

  /// Whether friction can carry any force.
  bool resists_sliding() const;
  /// Whether the tangential stiffness follows the load: what friction carries depends on the way there then, also
  /// where nothing slides.
  bool friction_follows_load() const;

 private:
  std::shared_ptr<const LawParameters> parameters_;
};

}  // namespace floc
