#include "floc/tables/fit_parameters.h"

#include <cmath>

namespace floc {
namespace {

/// Returns whether the data identify a parameter. A parameter without a value is not identified, and neither is one
/// whose value is too large for a number.
bool is_identified(const FittedParameter& p) {
  return p.identified && p.value && std::isfinite(*p.value);
}

/// Returns a parameter as it is printed: a value that the data do not identify is left out, whatever fit it comes from.
FittedParameter printed(FittedParameter p) {
  p.identified = is_identified(p);
  if (!p.identified) p.value = p.standard_error = std::nullopt;
  return p;
}

}  // namespace

Json number_or_null(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? Json(*x) : Json(nullptr);
}

Json parameters_as_json(const std::vector<FittedParameter>& parameters) {
  Json object = Json::object();
  for (const FittedParameter& parameter : parameters) {
    const FittedParameter p = printed(parameter);
    object[p.name] = {{"value", number_or_null(p.value)},
                      {"stderr", number_or_null(p.standard_error)},
                      {"low95", number_or_null(p.low95)},
                      {"high95", number_or_null(p.high95)},
                      {"identified", p.identified}};
  }
  return object;
}

Json pattern_as_json(const ResidualPattern& pattern) {
  return {{"correlation", number_or_null(pattern.correlation)},
          {"smoothness_p", number_or_null(pattern.smoothness_p)},
          {"runs_p", number_or_null(pattern.runs_p)},
          {"systematic", pattern.is_systematic()}};
}

std::vector<TableValue> parameter_cells(const FittedParameter& parameter) {
  const FittedParameter p = printed(parameter);
  const auto cell = [](const std::optional<double>& x) {
    return x && std::isfinite(*x) ? TableValue(*x) : TableValue();
  };
  return {cell(p.value), cell(p.standard_error), cell(p.low95), cell(p.high95), p.identified};
}

}  // namespace floc
