#include "floc/run/checkpoint.h"

#include <nlohmann/json.hpp>

#include "floc/base/error.h"

namespace floc {
namespace {

using Json = nlohmann::json;

/// Visits every member of a point under its name, so that writing and reading cannot differ.
template <class Point, class Visit>
void for_each_member(Point& point, const Visit& visit) {
  visit("step", point.step);
  visit("aggregating", point.aggregating);
  visit("stream_state", point.stream_state);
  visit("time", point.time);
  visit("n_steps", point.n_steps);
  visit("aggregation_skin", point.aggregation_skin);
  visit("parent_sha256", point.parent_sha256);
  visit("equilibration", point.equilibration);
  visit("equilibration_time", point.equilibration_time);
  visit("equilibration_steps", point.equilibration_steps);
}

}  // namespace

std::string progress_text(const RunPoint& point) {
  Json json;
  for_each_member(point, [&json](const char* name, const auto& value) { json[name] = value; });
  return json.dump();
}

RunPoint parse_progress(const std::string& text, const std::string& place) {
  RunPoint point;
  try {
    const Json json = Json::parse(text);
    for_each_member(point, [&json](const char* name, auto& value) { json.at(name).get_to(value); });
  } catch (const Json::exception& error) {
    throw InputError(place, std::string("is no checkpoint of this version: ") + error.what());
  }
  return point;
}

}  // namespace floc
