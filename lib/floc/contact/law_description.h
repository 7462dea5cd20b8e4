#pragma once

#include <string>
#include <vector>

#include "floc/contact/declaration.h"
#include "floc/contact/law.h"

/// Declarations of all slots without their types, for code that reads or writes laws by name.
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
  std::vector<std::string> keywords;  ///< the first is the default
};

/// A model that a slot can hold.
struct DeclaredModel {
  std::string keyword;
  bool is_default;  ///< taken where a scene names no model
  /// Whether every state file holds its numbers (kIsInEveryFile); they are zero where a law has another model.
  bool is_in_every_file;
  std::vector<DeclaredNumber> numbers;
  std::vector<DeclaredChoice> choices;
  /// Puts the model into the slot of a law, with all numbers zero and the first keyword of each choice.
  void (*choose)(LawParameters&);

  const DeclaredNumber* number(const std::string& number_key) const;
};

/// Whether a model can be combined with the other models of a law: the law has no more faults between its slots
/// with the model than without it.
bool fits(const DeclaredModel& model, LawParameters law);

struct DeclaredSlot {
  std::string key;                    ///< key of its table in a scene
  bool optional;                      ///< a law may leave it empty
  std::vector<DeclaredModel> models;  ///< without the empty slot

  /// Index in `models` of the model in this slot of a law; -1 if the slot is empty.
  int present(const LawParameters& law) const;
};

/// Whether a scene has to name the model of a slot, because the slot has no default model.
bool names_its_model(const DeclaredSlot& slot);

/// Table of a model in a scene, with the keys that it needs: "{law = "tail", force, range}".
std::string table_text(const DeclaredSlot& slot, const DeclaredModel& model);

/// All slots, in the order of LawParameters.
const std::vector<DeclaredSlot>& declared_slots();

/// Number of a law, with its key and its declaration.
struct LawNumber {
  std::string key;  ///< path below [contact]: "adhesion.force"
  double* value;
  const DeclaredNumber* declared;
};

/// Numbers of the models of a law, in the order of the slots.
std::vector<LawNumber> numbers_of(LawParameters& law);

/// Choice among keywords in a law.
struct LawChoice {
  std::string key;  ///< path below [contact]: "damping.mass"
  int chosen;       ///< index of its keyword
  const DeclaredChoice* declared;
};

std::vector<LawChoice> choices_of(const LawParameters& law);

/// Sets a choice of the model in a slot.
/// @param chosen  index of the keyword
/// @pre the model has a choice of that key with more than `chosen` keywords
void choose(LawParameters& law, const std::string& slot, const std::string& key, int chosen);

}  // namespace floc
