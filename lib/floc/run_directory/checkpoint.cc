#include "floc/run_directory/checkpoint.h"

#include "floc/relaxation/members_as_json.h"

namespace floc {
namespace {

/// Calls `visit` with the name and the value of each member of RunPoint that a checkpoint contains.
constexpr auto kMembers = [](auto& point, const auto& visit) {
  visit("step", point.step);
  visit("aggregating", point.aggregating);
  visit("shaken", point.shaken);
  visit("stream_state", point.stream_state);
  visit("time", point.time);
  visit("n_steps", point.n_steps);
  visit("aggregation_skin", point.aggregation_skin);
  visit("parent_sha256", point.parent_sha256);
  visit("last_sides", point.last_sides);
  visit("last_stress", point.last_stress);
  visit("last_offset", point.last_offset);
  visit("turn_control", point.turn.control);
  visit("turn_axis", point.turn.axis);
  visit("turn_sides", point.turn.sides);
  visit("turn_stress", point.turn.stress);
  visit("turn_shear", point.turn.shear);
  visit("equilibration", point.equilibration);
  visit("equilibration_time", point.equilibration_time);
  visit("equilibration_steps", point.equilibration_steps);
};

}  // namespace

std::string progress_text(const RunPoint& point) {
  return members_as_json(point, kMembers);
}

RunPoint parse_progress(const std::string& text, const std::string& place) {
  return members_from_json<RunPoint>(text, place, "this is not a checkpoint of this version of floc", kMembers);
}

}  // namespace floc
