#pragma once

#include <string>
#include <vector>

#include "floc/contact/declaration.h"
#include "floc/contact/law.h"

/// The declarations of all slots without their types, for code that reads or writes laws by name.
namespace floc {

struct DeclaredNumber {
  std::string key;
  Unit unit;
  std::string symbol;
  Requirement requirement;
  Requirement at_first;
  std::string expectation;
  std::string meaning;
};

struct DeclaredChoice {
  std::string key;
  std::vector<std::string> keywords;  ///< the first is taken where nothing is said
};

/// A model that a slot can hold.
struct DeclaredModel {
  std::string keyword;
  bool is_default;  ///< taken where a scene names no model
  /// Its numbers are in every state file, as in older ones: zero where a law has another model.
  bool is_in_every_file;
  std::vector<DeclaredNumber> numbers;
  std::vector<DeclaredChoice> choices;
  /// Puts the model into the slot of a law, with its numbers zero and its choices the first.
  void (*choose)(LawParameters&);

  const DeclaredNumber* number(const std::string& number_key) const;
};

/// Whether a law has no more faults between its slots with this model than without: the model goes together
/// with the others.
bool fits(const DeclaredModel& model, LawParameters law);

struct DeclaredSlot {
  std::string key;                    ///< of its table in a scene
  bool optional;                      ///< a law may leave it empty
  std::vector<DeclaredModel> models;  ///< absence not among them

  /// Index in `models` of what this slot of a law holds, -1 if nothing.
  int present(const LawParameters& law) const;
};

/// Whether a scene has to name the model of a slot: where none is meant without a name.
bool names_its_model(const DeclaredSlot& slot);

/// A model as a scene gives it, with the keys that it needs: "{law = "tail", force, range}".
std::string table_text(const DeclaredSlot& slot, const DeclaredModel& model);

/// All slots, in the order of LawParameters.
const std::vector<DeclaredSlot>& declared_slots();

/// A number that a law has.
struct LawNumber {
  std::string key;  ///< path below [contact]: "adhesion.force"
  double* value;
  const DeclaredNumber* declared;
};

/// The numbers of the models that a law has, in the order of the slots.
std::vector<LawNumber> numbers_of(LawParameters& law);

/// A choice that a law has made.
struct LawChoice {
  std::string key;  ///< path below [contact]: "damping.mass"
  int chosen;       ///< index of its keyword
  const DeclaredChoice* declared;
};

std::vector<LawChoice> choices_of(const LawParameters& law);

/// Makes a choice of the model that a slot holds. @pre it has a choice of that key with enough keywords
void choose(LawParameters& law, const std::string& slot, const std::string& key, int chosen);

}  // namespace floc
