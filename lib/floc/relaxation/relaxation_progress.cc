#include "floc/relaxation/relaxation_progress.h"

#include "floc/relaxation/members_as_json.h"

namespace floc {
namespace {

/// Function that calls visit(name, member) for the members of a RelaxationProgress, with the names that they have in
/// checkpoints.
constexpr auto kProgressMembers = [](auto& p, const auto& visit) {
  visit("stage", p.phase);
  visit("n_steps", p.n_steps);
  visit("time", p.time);
  visit("skin", p.skin);
  visit("solid_fraction", p.solid_fraction);
  visit("imbalance_sign", p.imbalance_sign);
  visit("side_before", p.side_before);
  visit("offset_before", p.offset_before);
  visit("way_duration", p.ramp_duration);
  visit("carried_stress", p.carried_stress);
  visit("finishing_since_stress", p.finishing_since_stress);
  visit("contact_set", p.contact_set);
  visit("unchanged_stretches", p.unchanged_chunks);
  visit("finishing_since_phi", p.finishing_since_phi);
  visit("finishing_stretches", p.finishing_chunks);
  visit("next_polish", p.next_refinement);
  visit("force_residual", p.force_residual);
};

/// Function that calls visit(name, member) for those members of a RelaxationProgress that were added in later versions
/// of floc. A checkpoint contains such a member only if it is not zero; if all are zero, the checkpoint has the format
/// of earlier versions.
constexpr auto kLaterMembers = [](auto& p, const auto& visit) {
  visit("liquid_trials", p.liquid_trials);
  visit("steady_stretches", p.steady_chunks);
  visit("steady_since_phi", p.steady_since_phi);
  visit("refused_within", p.refused_within);
};

}  // namespace

std::string as_text(const RelaxationProgress& progress) {
  nlohmann::json json = nlohmann::json::parse(members_as_json(progress, kProgressMembers));
  kLaterMembers(progress, [&json](const char* name, const auto& value) {
    if (value != 0) json[name] = value;
  });
  return json.dump();
}

RelaxationProgress relaxation_progress(const std::string& text) {
  auto progress = members_from_json<RelaxationProgress>(
      text, "progress",
      "the text does not contain the progress of a relaxation in the format of this version of floc",
      kProgressMembers);
  const nlohmann::json json = nlohmann::json::parse(text);
  kLaterMembers(progress, [&json](const char* name, auto& value) {
    if (json.contains(name)) json[name].get_to(value);
  });
  return progress;
}

}  // namespace floc
