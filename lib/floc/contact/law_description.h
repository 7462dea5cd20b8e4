#pragma once

#include <string>
#include <vector>

#include "floc/contact/declaration.h"
#include "floc/contact/law.h"

/// Declarations of all slots of a contact law and of their models, without C++ types, for code that reads or
/// writes laws by name.
namespace floc {

/// Numeric parameter of a model of a contact law, as the model declares it with a Number (declaration.h).
struct DeclaredNumber {
  std::string key;
  Unit unit;
  std::string symbol;
  Requirement requirement;
  Requirement at_first;
  std::string expectation;
  std::string meaning;
};

/// Parameter with a keyword as value, as a model declares it with a Choice (declaration.h).
struct DeclaredChoice {
  std::string key;
  std::vector<std::string> keywords;  ///< allowed keywords; the first keyword is the default
};

/// Declaration of a model that a slot of a contact law can hold.
struct DeclaredModel {
  std::string keyword;
  bool is_default;  ///< whether this model is chosen if a scene file names no model for the slot
  /// Whether this model is the second default: it replaces the default model if it can be combined with the normal law.
  bool is_default_of_family;
  /// Whether every state file stores the numbers of this model (kIsInEveryFile). If the contact law has another model
  /// in the slot, these numbers are zero.
  bool is_in_every_file;
  std::vector<DeclaredNumber> numbers;
  std::vector<DeclaredChoice> choices;
  /// Puts the model into a law, with all numbers zero and the first keyword of each choice.
  void (*choose)(LawParameters&);

  const DeclaredNumber* number(const std::string& number_key) const;
};

/// Returns whether a model can be added to a contact law without a new conflict between the models of the law.
bool fits(const DeclaredModel& model, LawParameters law);

/// Declaration of a slot of a contact law (normal, adhesion, damping, ...) and of the models that it can hold.
struct DeclaredSlot {
  /// Key of the table of this slot in a scene file, such as "friction".
  std::string key;
  bool optional;                      ///< whether a law may leave this slot empty
  std::vector<DeclaredModel> models;  ///< models that this slot can hold

  /// Returns the index in `models` of the model that a law has in this slot; -1 if the slot is empty.
  int present(const LawParameters& law) const;
};

/// Returns whether a scene file has to name the model of this slot of the contact law, because the slot has no default
/// model.
bool names_its_model(const DeclaredSlot& slot);

/// Returns the table that describes a model in a scene file, for use in messages. The text lists the keys that the
/// table needs, without their values: `{law = "tail", force, range}`.
std::string table_text(const DeclaredSlot& slot, const DeclaredModel& model);

/// Returns the declarations of all slots of a contact law (normal, adhesion, ...), in the order of
/// LawParameters.
const std::vector<DeclaredSlot>& declared_slots();

/// Numeric parameter of a contact law: its key, its value and its declaration.
struct LawNumber {
  std::string key;  ///< key in the table [contact] of a scene file, such as "adhesion.force"
  double* value;
  const DeclaredNumber* declared;
};

/// Returns the numeric parameters of the models of a law, in the order of LawParameters.
std::vector<LawNumber> numbers_of(LawParameters& law);

/// Parameter with a keyword as value, of a model of a contact law.
struct LawChoice {
  std::string key;  ///< key in the table [contact] of a scene file, such as "damping.mass"
  int chosen;       ///< index of the chosen keyword in declared->keywords
  const DeclaredChoice* declared;
};

std::vector<LawChoice> choices_of(const LawParameters& law);

/// Sets a parameter of a contact law to one of its allowed keywords.
/// @param slot  key of the slot whose model has the parameter, such as "damping"
/// @param key  key of the parameter in the table of the slot, such as "mass"
/// @param chosen  index of the keyword in the declaration of the parameter (DeclaredChoice)
/// @pre the model in the slot has a parameter with this key, which allows more than `chosen` keywords
void choose(LawParameters& law, const std::string& slot, const std::string& key, int chosen);

}  // namespace floc
