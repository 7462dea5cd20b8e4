#pragma once

#include <type_traits>

/// Declarations of a model of a contact law: its keyword, its numbers and choices, and the history that a
/// contact keeps for it. Each model makes them once; validation, scenes, changes along a load path, law texts,
/// state files, kernels and dimensionless groups all iterate over them.
namespace floc {

/// Unit of a number of a contact law.
enum class Unit {
  ratio,              ///< dimensionless
  length,             ///< (length)
  force,              ///< (force)
  stiffness,          ///< (force/length)
  rolling_stiffness,  ///< (force * length)
  angle,              ///< (radians)
  degrees,            ///< an angle (degrees)
  volume,             ///< (length^3)
  pressure,           ///< (force/length^2)
};

/// Values that a number may have; all must also be finite.
enum class Requirement {
  positive,
  not_negative,
  at_most_one,    ///< in (0, 1]
  poisson_ratio,  ///< in (-1, 0.5)
  acute_angle,    ///< in [0, 90] (degrees)
};

constexpr bool holds(Requirement requirement, double x) {
  switch (requirement) {
    case Requirement::positive:
      return x > 0;
    case Requirement::not_negative:
      return x >= 0;
    case Requirement::at_most_one:
      return x > 0 && x <= 1;
    case Requirement::poisson_ratio:
      return x > -1 && x < 0.5;
    case Requirement::acute_angle:
      return x >= 0 && x <= 90;
  }
  return false;
}

/// One number of a model.
template <class Model>
struct Number {
  const char* key;  ///< key in scenes: contact.SLOT.KEY
  double Model::*member;
  Unit unit;
  const char* symbol;       ///< symbol in formulas, such as "K_N"
  Requirement requirement;  ///< requirement on every value, also on those set along a load path
  const char* expectation;  ///< value that a scene has to give, in words
  const char* meaning;      ///< meaning in one line
  /// Requirement on the value in a scene. It may be stricter: a change along the load path may switch a slot
  /// off by zero.
  Requirement at_first = requirement;
};

/// Requirement on two numbers of a model, besides those on each: `larger` is at least as large as `smaller`.
template <class Model>
struct AtLeast {
  double Model::*larger;
  double Model::*smaller;
};

/// One choice among keywords, optional in a scene: the first keyword is the default.
template <class Model>
struct Choice {
  const char* key;
  const char* const* keywords;  ///< ended by a null pointer
  int (*get)(const Model&);
  void (*set)(Model&, int);
};

/// get() and set() of a choice that a member of the model holds as an enumeration. Functions and not lambdas: a
/// model declares its choices before its own definition is complete.
template <class Model, auto kMember>
int chosen(const Model& model) {
  return static_cast<int>(model.*kMember);
}
template <class Model, auto kMember>
void choose(Model& model, int keyword) {
  model.*kMember = static_cast<std::remove_reference_t<decltype(model.*kMember)>>(keyword);
}

/// Transformation of a quantity of the history.
enum class HistoryKind {
  scalar,    ///< a number that does not change when i and j are exchanged
  tangent,   ///< a displacement of j against i in the tangent plane, in the contact's frame
  rotation,  ///< a rotation of i against j; in 3D about an axis in the tangent plane
  twist,  ///< in 3D, a rotation of i against j about the normal; it does not change when i and j are exchanged
};

/// One quantity of the history that a model keeps per contact.
struct History {
  const char* name;  ///< name of its array in a state file
  HistoryKind kind;
  Unit unit;
  const char* meaning;  ///< meaning in words
};

/// Whether a quantity is a vector in the tangent plane and turns with it.
constexpr bool is_tangential(HistoryKind kind) {
  return kind == HistoryKind::tangent || kind == HistoryKind::rotation;
}

/// Number of components of a quantity: 2D tangents and rotations are one number, their 3D counterparts are
/// vectors in space.
constexpr int n_components(HistoryKind kind, int dim) {
  return is_tangential(kind) && dim == 3 ? 3 : 1;
}

/// Factor of each component when i and j are exchanged. A 2D tangent displacement changes sign, and so does the
/// tangent along which it is measured, which turns round with the normal.
constexpr double parity(HistoryKind kind, int dim) {
  if (!is_tangential(kind)) return 1.0;
  return kind == HistoryKind::tangent && dim == 2 ? 1.0 : -1.0;
}

}  // namespace floc
