#pragma once

#include <type_traits>

/// What a model of a contact law declares, once: its keyword, its numbers and choices, and what a contact
/// remembers for it. Validation, scenes, changes along a load path, law texts, state files, kernels and
/// dimensionless groups all iterate over these declarations.
namespace floc {

/// What a number of a contact law measures.
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
  const char* key;  ///< in scenes: contact.SLOT.KEY
  double Model::*member;
  Unit unit;
  const char* symbol;       ///< in formulas, "K_N"
  Requirement requirement;  ///< on any value it ever has
  const char* expectation;  ///< what a scene has to give, in words
  const char* meaning;      ///< in one line
  /// Requirement on the value in a scene, where that is stricter: zero may switch a slot off later.
  Requirement at_first = requirement;
};

/// A requirement on two numbers of a model, besides those on each: the first is at least as large as the second.
template <class Model>
struct AtLeast {
  double Model::*larger;
  double Model::*smaller;
};

/// One choice among keywords, optional in a scene: the first one where nothing is said.
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

/// How a remembered quantity transforms.
enum class HistoryKind {
  scalar,    ///< a number, the same whichever way round the pair is read
  tangent,   ///< a displacement of j against i in the tangent plane, in the contact's frame
  rotation,  ///< a rotation of i against j; in 3D one about an axis in the tangent plane
  twist,  ///< in 3D, a rotation of i against j about the normal, the same whichever way round the pair is read
};

/// One quantity that a contact remembers under a model.
struct History {
  const char* name;  ///< of its array in a state file
  HistoryKind kind;
  Unit unit;
  const char* meaning;  ///< in words
};

/// Whether a quantity lies in the tangent plane, and turns with it.
constexpr bool is_tangential(HistoryKind kind) {
  return kind == HistoryKind::tangent || kind == HistoryKind::rotation;
}

/// Numbers that it takes: 2D tangents and rotations are one number, their 3D counterparts vectors in space.
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
