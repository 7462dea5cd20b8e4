#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "floc/contact/absent.h"

namespace floc {

/// Slot of a contact law (normal, adhesion, damping, ...) as a scene file or a saved state describes it. It holds an
/// object of one of the types `Models`: a model with its numbers or, if the slot is empty, Absent (absent.h). If a slot
/// may be empty, Absent is the first of its types.
template <class... Models>
class LawSlot {
 public:
  using Variant = std::variant<Models...>;

  LawSlot() = default;
  template <class Model>
  requires(std::is_same_v<Model, Models> || ...) LawSlot(const Model& model)
      : model_(model) {}  // NOLINT(google-explicit-constructor)

  /// Returns whether the slot holds a model of the contact law.
  explicit operator bool() const {
    return visit([]<class Model>(const Model&) { return !kIsAbsent<Model>; });
  }
  void reset() { model_ = {}; }

  template <class Model>
  bool holds() const {
    return std::holds_alternative<Model>(model_);
  }
  /// Returns the model in the slot. @pre holds<Model>()
  template <class Model>
  Model& get() {
    return std::get<Model>(model_);
  }
  template <class Model>
  const Model& get() const {
    return std::get<Model>(model_);
  }

  template <class Visitor>
  decltype(auto) visit(Visitor&& visitor) {
    return std::visit(std::forward<Visitor>(visitor), model_);
  }
  template <class Visitor>
  decltype(auto) visit(Visitor&& visitor) const {
    return std::visit(std::forward<Visitor>(visitor), model_);
  }

  const Variant& variant() const { return model_; }

  bool operator==(const LawSlot&) const = default;

 private:
  Variant model_;
};

}  // namespace floc
