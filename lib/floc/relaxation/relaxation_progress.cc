#include "floc/relaxation/relaxation_progress.h"

#include <nlohmann/json.hpp>

#include "floc/base/error.h"

namespace floc {
namespace {

using Json = nlohmann::json;

/// Visits every member under its name, so that writing and reading cannot differ.
template <class Progress, class Visit>
void for_each_member(Progress& p, const Visit& visit) {
  visit("stage", p.stage);
  visit("n_steps", p.n_steps);
  visit("time", p.time);
  visit("skin", p.skin);
  visit("solid_fraction", p.solid_fraction);
  visit("imbalance_sign", p.imbalance_sign);
  visit("contact_set", p.contact_set);
  visit("unchanged_stretches", p.unchanged_stretches);
  visit("finishing_since_phi", p.finishing_since_phi);
  visit("finishing_stretches", p.finishing_stretches);
  visit("next_polish", p.next_polish);
  visit("force_residual", p.force_residual);
}

}  // namespace

std::string as_text(const RelaxationProgress& progress) {
  Json json;
  for_each_member(progress, [&json](const char* name, const auto& value) { json[name] = value; });
  return json.dump();
}

RelaxationProgress relaxation_progress(const std::string& text) {
  RelaxationProgress progress;
  try {
    const Json json = Json::parse(text);
    for_each_member(progress, [&json](const char* name, auto& value) { json.at(name).get_to(value); });
  } catch (const Json::exception& error) {
    throw InputError("progress", std::string("is not that of a relaxation of this version: ") + error.what());
  }
  return progress;
}

}  // namespace floc
