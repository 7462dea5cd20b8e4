#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "floc/contact/declaration.h"
#include "floc/contact/law_parameters.h"

namespace floc {

/// Returns one fault for each violated relation between two numbers of a model (Model::kRelations, AtLeast).
/// @param slot  key of the table that describes the model in a scene file, such as "friction"
template <class Model>
std::vector<LawFault> relation_faults(const std::string& slot, const Model& model) {
  std::vector<LawFault> faults;
  if constexpr (requires { Model::kRelations; }) {
    const auto key_of = [](double Model::*member) {
      return std::find_if(std::begin(Model::kNumbers), std::end(Model::kNumbers),
                          [&](const Number<Model>& n) { return n.member == member; })
          ->key;
    };
    for (const AtLeast<Model>& relation : Model::kRelations) {
      const double larger = model.*relation.larger, smaller = model.*relation.smaller;
      if (larger >= smaller) continue;
      const char* const key = key_of(relation.larger);
      faults.push_back({slot,
                        fmt::format("contact.{0}.{1} = {2}: expected at least contact.{0}.{3} = {4}", slot, key,
                                    larger, key_of(relation.smaller), smaller),
                        key});
    }
  }
  return faults;
}

}  // namespace floc
