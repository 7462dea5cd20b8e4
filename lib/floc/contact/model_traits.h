#pragma once

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

/// Whether the stiffness of a normal law varies with the overlap.
template <class Normal>
inline constexpr bool kStiffnessVaries = requires {
  requires Normal::kStiffnessVaries;
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

/// Whether the numbers of a model are only in the state files of laws that have it.
template <class Model>
inline constexpr bool kIsInItsOwnFilesOnly = requires {
  requires Model::kIsInItsOwnFilesOnly;
};

}  // namespace floc
