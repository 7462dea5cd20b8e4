#pragma once

#include <string_view>

/// Traits of the models of a contact law. A model declares only those in which it departs from the default.
namespace floc {

/// Dimension that a model is made for, 2 or 3; 0 if it is made for both.
template <class Model>
constexpr int dimension_of() {
  if constexpr (requires { Model::kDimension; }) return Model::kDimension;
  return 0;
}
template <class Model>
inline constexpr int kDimensionOf = dimension_of<Model>();

/// Whether a scene that gives numbers of the slot and names no model gets this model.
template <class Model>
inline constexpr bool kIsDefault = requires {
  requires Model::kIsDefault;
};

/// Family of contacts that a model is made for. Models can be combined within a family, and with models of no
/// family.
enum class Family {
  none,             ///< any contact
  springs,          ///< contacts of constant stiffnesses, each slot with its own
  elastic_spheres,  ///< contacts whose stiffnesses all follow from the material and the overlap
};

template <class Model>
constexpr Family family_of() {
  if constexpr (requires { Model::kFamily; }) return Model::kFamily;
  return Family::none;
}

/// Reason why a model of a slot cannot be combined with a normal law of another family, to be put after "under
/// which" in a message; empty where no reason is known.
constexpr std::string_view family_rule(Family of_normal, std::string_view slot) {
  if (of_normal != Family::elastic_spheres) return "";
  if (slot == "adhesion") return "spheres adhere only by liquid";
  if (slot == "damping") return "damping follows the stiffness";
  if (slot == "friction") return "its stiffness follows from Poisson's ratio";
  return "spheres do not resist it";
}

/// Whether a normal law includes adhesion, so that no model of adhesion can be combined with it.
template <class Normal>
inline constexpr bool kAdheresByItself = requires {
  requires Normal::kAdheres;
};

/// Whether a model is a model of adhesion. Only these have a range.
template <class Model>
inline constexpr bool kIsAdhesion = requires(const Model& model) {
  model.range();
};

/// Whether a model of another slot can be combined with a normal law.
template <class Normal, class Model>
inline constexpr bool kGoesWith = (family_of<Model>() == Family::none ||
                                   family_of<Model>() == family_of<Normal>()) &&
                                  !(kAdheresByItself<Normal> && kIsAdhesion<Model>);

/// Exponent of the overlap in the elastic force of a normal law. The default is 1: a contact of constant
/// stiffness.
template <class Normal>
constexpr double force_exponent() {
  if constexpr (requires { Normal::kForceExponent; }) return Normal::kForceExponent;
  return 1.0;
}

/// Whether a normal law holds only for overlaps that are small compared with the grains.
template <class Normal>
inline constexpr bool kIsForSmallOverlaps = requires {
  requires Normal::kIsForSmallOverlaps;
};

/// Whether the stiffness or the damping of a model follows from the present normal stiffness.
template <class Model>
inline constexpr bool kFollowsNormalStiffness = requires {
  requires Model::kFollowsNormalStiffness;
};

/// Whether a model of adhesion describes liquid bridges. Their volumes are part of the history.
template <class Model>
inline constexpr bool kHoldsLiquid = requires {
  requires Model::kHoldsLiquid;
};

/// Whether grains with this adhesion roll freely: it cannot be combined with rolling or twisting resistance,
/// whatever the normal law.
template <class Model>
inline constexpr bool kRollsFreely = requires {
  requires Model::kRollsFreely;
};

/// Whether state files hold the numbers of a model under every law, also where the law does not have the model.
template <class Model>
inline constexpr bool kIsInEveryFile = requires {
  requires Model::kIsInEveryFile;
};

}  // namespace floc
