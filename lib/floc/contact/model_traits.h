#pragma once

#include <string_view>

#include "floc/contact/absent.h"

/// Traits of the models of a contact law. A model declares only the traits in which it differs from the
/// default.
namespace floc {

/// Space dimension for which a model is made, 2 or 3; 0 if the model is made for both.
template <class Model>
constexpr int dimension_of() {
  if constexpr (requires { Model::kDimension; }) return Model::kDimension;
  return 0;
}
template <class Model>
inline constexpr int kDimensionOf = dimension_of<Model>();

/// Whether this model is chosen if a table of a scene file, such as contact.friction, gives numbers but names no model.
template <class Model>
inline constexpr bool kIsDefault = requires {
  requires Model::kIsDefault;
};

/// Whether this model replaces the default model of its slot if the normal law belongs to the family of this model. A
/// default is chosen if a table gives numbers but names no model.
template <class Model>
inline constexpr bool kIsDefaultOfFamily = requires {
  requires Model::kIsDefaultOfFamily;
};

/// Family of contacts for which a model is made. Models can be combined with models of the same family, and with models
/// that belong to no family.
enum class Family {
  none,             ///< contacts of any kind
  springs,          ///< contacts of constant stiffnesses; each model has its own stiffness
  elastic_spheres,  ///< contacts whose stiffnesses all follow from the material and the overlap
  rigid,  ///< contacts whose surfaces do not overlap, and whose forces follow from the balance of the grains
};

template <class Model>
constexpr Family family_of() {
  if constexpr (requires { Model::kFamily; }) return Model::kFamily;
  return Family::none;
}

/// Returns the reason why a model of a contact law cannot be combined with a normal law of another Family, as a clause
/// that follows "because" in a message; empty if no reason is known.
constexpr std::string_view family_rule(Family of_normal, std::string_view slot) {
  if (of_normal == Family::rigid && slot == "damping") return "rigid contacts have no dashpots";
  if (of_normal == Family::rigid && slot == "friction")
    return "the friction of rigid contacts has no stiffness";
  if (of_normal == Family::rigid && slot == "adhesion") return "rigid contacts adhere only by a constant force";
  if (of_normal == Family::rigid)
    return "rigid contacts do not resist rolling or twisting in this version of floc";
  if (of_normal != Family::elastic_spheres) return "";
  if (slot == "adhesion") return "elastic spheres adhere only by liquid bridges";
  if (slot == "damping") return "the damping of elastic spheres follows the normal stiffness";
  if (slot == "friction") return "the tangential stiffness of elastic spheres follows from Poisson's ratio";
  return "elastic spheres do not resist rolling or twisting";
}

/// Whether a normal law includes adhesion, so that no model of adhesion can be combined with it.
template <class Normal>
inline constexpr bool kAdheresByItself = requires {
  requires Normal::kAdheres;
};

/// Whether a model describes adhesion. Only models of adhesion have the function range().
template <class Model>
inline constexpr bool kIsAdhesion = requires(const Model& model) {
  model.range();
};

/// Whether a model can be combined with rigid contacts. Models made only for rigid contacts belong to Family::rigid and
/// do not need this trait.
template <class Model>
inline constexpr bool kGoesWithRigid = kIsAbsent<Model> || requires {
  requires Model::kGoesWithRigid;
};

/// Whether a model of adhesion, damping, friction, rolling or twisting can be combined with a normal law.
template <class Normal, class Model>
inline constexpr bool kGoesWith =
    (family_of<Normal>() == family_of<Model>() ||
     (family_of<Normal>() == Family::rigid ? kGoesWithRigid<Model> : family_of<Model>() == Family::none)) &&
    !(kAdheresByItself<Normal> && kIsAdhesion<Model>);

/// Returns the exponent of the overlap in the elastic force of a normal law. The default is 1: a contact of
/// constant stiffness.
template <class Normal>
constexpr double force_exponent() {
  if constexpr (requires { Normal::kForceExponent; }) return Normal::kForceExponent;
  return 1.0;
}

/// Whether a normal law is valid only for overlaps that are small compared with the grains.
template <class Normal>
inline constexpr bool kIsForSmallOverlaps = requires {
  requires Normal::kIsForSmallOverlaps;
};

/// Whether the stiffness or the damping coefficient of a model is computed from the present normal stiffness.
template <class Model>
inline constexpr bool kFollowsNormalStiffness = requires {
  requires Model::kFollowsNormalStiffness;
};

/// Whether a model of adhesion describes liquid bridges. The volume of each bridge is part of the history of
/// its contact.
template <class Model>
inline constexpr bool kHoldsLiquid = requires {
  requires Model::kHoldsLiquid;
};

/// Whether grains under this model of adhesion roll freely. The model then cannot be combined with rolling or
/// twisting resistance under any normal law.
template <class Model>
inline constexpr bool kRollsFreely = requires {
  requires Model::kRollsFreely;
};

/// Whether every state file stores the numbers of a model, even if the contact law of the state does not have this
/// model.
template <class Model>
inline constexpr bool kIsInEveryFile = requires {
  requires Model::kIsInEveryFile;
};

}  // namespace floc
