#include "floc/tables/fit_parameters.h"

#include <cmath>

namespace floc {

Json number_or_null(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? Json(*x) : Json(nullptr);
}

Json parameters_as_json(const std::vector<FittedParameter>& parameters) {
  Json object = Json::object();
  for (const FittedParameter& p : parameters)
    object[p.name] = {{"value", number_or_null(p.value)},
                      {"stderr", number_or_null(p.standard_error)},
                      {"low95", number_or_null(p.low95)},
                      {"high95", number_or_null(p.high95)},
                      {"identified", p.identified}};
  return object;
}

Json pattern_as_json(const ResidualPattern& pattern) {
  return {{"correlation", number_or_null(pattern.correlation)},
          {"smoothness_p", number_or_null(pattern.smoothness_p)},
          {"runs_p", number_or_null(pattern.runs_p)},
          {"systematic", pattern.is_systematic()}};
}

std::vector<TableValue> parameter_cells(const FittedParameter& p) {
  const auto cell = [](const std::optional<double>& x) { return x ? TableValue(*x) : TableValue(); };
  return {cell(p.value), cell(p.standard_error), cell(p.low95), cell(p.high95), p.identified};
}

}  // namespace floc
