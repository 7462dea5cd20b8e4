#pragma once

#include <type_traits>

/// Declarations of a model of a contact law: its keyword, its parameters (numbers and choices among keywords), and the
/// history that it stores per contact. Each model is declared once. All code that handles parameters and histories
/// iterates over these declarations, for example the code that validates laws, reads scene files, changes laws along a
/// load path, describes laws in texts, writes state files, and computes forces and dimensionless groups.
namespace floc {

/// Unit of a parameter of a contact law.
enum class Unit {
  ratio,              ///< dimensionless number
  length,             ///< unit of length
  force,              ///< unit of force
  stiffness,          ///< force/length
  rolling_stiffness,  ///< force * length
  angle,              ///< radians
  degrees,            ///< degrees
  volume,             ///< length^3
  pressure,           ///< force/length^2
};

/// Range of values allowed for a parameter of a contact law. All values must also be finite.
enum class Requirement {
  positive,
  not_negative,
  at_most_one,    ///< value in (0, 1]
  poisson_ratio,  ///< value in (-1, 0.5)
  acute_angle,    ///< angle in [0, 90] degrees
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

/// Declaration of one numeric parameter of a model of a contact law.
template <class Model>
struct Number {
  const char* key;  ///< last part, KEY, of the key contact.SLOT.KEY in a scene file
  double Model::*member;
  Unit unit;
  const char* symbol;       ///< symbol of the parameter in formulas, such as "K_N" for a stiffness
  Requirement requirement;  ///< requirement on every value, including values that a load path sets
  const char* expectation;  ///< description of the values that a scene file may give, for messages
  const char* meaning;      ///< description of the parameter in one line
  /// Requirement on the value given in a scene file. This requirement may be stricter than `requirement`, because a
  /// change along a load path may set the parameter to zero in order to switch off its model.
  Requirement at_first = requirement;
};

/// Requirement on two numbers of a model: `larger` must be at least as large as `smaller`.
template <class Model>
struct AtLeast {
  double Model::*larger;
  double Model::*smaller;
};

/// Declaration of a parameter whose value is a keyword, for a model of a contact law. The parameter is optional in a
/// scene file; its first keyword is the default.
template <class Model>
struct Choice {
  const char* key;
  const char* const* keywords;  ///< allowed keywords, terminated by a null pointer
  int (*get)(const Model&);
  void (*set)(Model&, int);
};

/// Two functions that get and set the index of the chosen keyword, for a model that stores its choice as an enumeration
/// in the member `kMember`. Choice::get and Choice::set point to these functions. Lambdas cannot replace the functions,
/// because a model declares its choices before its own definition is complete.
template <class Model, auto kMember>
int chosen(const Model& model) {
  return static_cast<int>(model.*kMember);
}
template <class Model, auto kMember>
void choose(Model& model, int keyword) {
  model.*kMember = static_cast<std::remove_reference_t<decltype(model.*kMember)>>(keyword);
}

/// Kind of a quantity in the history of a contact. The kind determines how the quantity changes if the grains i and j
/// are exchanged or if the contact turns.
enum class HistoryKind {
  scalar,   ///< a number that does not change when grains i and j are exchanged
  tangent,  ///< a displacement of grain j relative to grain i in the tangent plane, in the frame of the contact
  rotation,  ///< a rotation of grain i relative to grain j; in 3D about an axis in the tangent plane
  /// In 3D, a rotation of grain i relative to grain j about the normal; it does not change when i and j are
  /// exchanged.
  twist,
};

/// Declaration of one quantity that a model of a contact law stores per contact.
struct History {
  const char* name;  ///< name of the array of this quantity in a state file
  HistoryKind kind;
  Unit unit;
  const char* meaning;  ///< description of the quantity, for users
};

/// Returns whether a quantity in the history of a contact is a vector in the tangent plane of the contact, so that it
/// turns with this plane.
constexpr bool is_tangential(HistoryKind kind) {
  return kind == HistoryKind::tangent || kind == HistoryKind::rotation;
}

/// Returns the number of components of a quantity in the history of a contact. Displacements and rotations in the
/// tangent plane are one number in 2D and vectors of three components in 3D.
constexpr int n_components(HistoryKind kind, int dim) {
  return is_tangential(kind) && dim == 3 ? 3 : 1;
}

/// Returns the factor by which each component of a quantity in the history of a contact is multiplied when the grains i
/// and j of the contact are exchanged. The factor is 1 for a 2D tangential displacement, because the displacement and
/// the tangent along which it is measured both change sign.
constexpr double parity(HistoryKind kind, int dim) {
  if (!is_tangential(kind)) return 1.0;
  return kind == HistoryKind::tangent && dim == 2 ? 1.0 : -1.0;
}

}  // namespace floc
