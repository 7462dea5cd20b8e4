#pragma once

#include <string_view>

/// What models of a contact law declare where they depart from the rule.
namespace floc {

/// Dimension that a model is for; 0: any.
template <class Model>
constexpr int dimension_of() {
  if constexpr (requires { Model::kDimension; }) return Model::kDimension;
  return 0;
}
template <class Model>
inline constexpr int kDimensionOf = dimension_of<Model>();

/// Whether a model is meant where a scene gives numbers of its slot and names no model.
template <class Model>
inline constexpr bool kIsDefault = requires {
  requires Model::kIsDefault;
};

/// Contacts that a model is made for. It goes with models of its own family, and with those of none.
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

/// Why models of a slot do not go with normal laws of a family that is not theirs, after "under which"; empty where
/// there is no more to say.
constexpr std::string_view family_rule(Family of_normal, std::string_view slot) {
  if (of_normal != Family::elastic_spheres) return "";
  if (slot == "adhesion") return "spheres adhere only by liquid";
  if (slot == "damping") return "damping follows the stiffness";
  if (slot == "friction") return "its stiffness follows from Poisson's ratio";
  return "spheres do not resist it";
}

/// Whether surfaces adhere under a normal law alone, so that no adhesion goes with it.
template <class Normal>
inline constexpr bool kAdheresByItself = requires {
  requires Normal::kAdheres;
};

/// Whether a model is one of adhesion: these alone have a range.
template <class Model>
inline constexpr bool kIsAdhesion = requires(const Model& model) {
  model.range();
};

/// Whether a model of another slot goes with a normal law.
template <class Normal, class Model>
inline constexpr bool kGoesWith = (family_of<Model>() == Family::none ||
                                   family_of<Model>() == family_of<Normal>()) &&
                                  !(kAdheresByItself<Normal> && kIsAdhesion<Model>);

/// Power of the overlap that the elastic force of a normal law grows with. 1 unless the law says otherwise: the
/// stiffness of its contacts does not depend on the load.
template <class Normal>
constexpr double force_exponent() {
  if constexpr (requires { Normal::kForceExponent; }) return Normal::kForceExponent;
  return 1.0;
}

/// Whether a normal law holds for overlaps that are small beside the grains alone.
template <class Normal>
inline constexpr bool kIsForSmallOverlaps = requires {
  requires Normal::kIsForSmallOverlaps;
};

/// Whether a model takes its stiffness, or its damping, from the present stiffness along the normal.
template <class Model>
inline constexpr bool kFollowsNormalStiffness = requires {
  requires Model::kFollowsNormalStiffness;
};

/// Whether the adhesion is that of liquid bridges, whose volumes contacts remember.
template <class Model>
inline constexpr bool kHoldsLiquid = requires {
  requires Model::kHoldsLiquid;
};

/// Whether grains with this adhesion roll freely, under springs as under any other normal law.
template <class Model>
inline constexpr bool kRollsFreely = requires {
  requires Model::kRollsFreely;
};

/// Whether the numbers of a model are in the state files of all laws, as they have been since before there were others.
template <class Model>
inline constexpr bool kIsInEveryFile = requires {
  requires Model::kIsInEveryFile;
};

}  // namespace floc
