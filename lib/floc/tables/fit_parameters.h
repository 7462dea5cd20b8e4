#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/residual_pattern.h"
#include "floc/io/table.h"

namespace floc {

using Json = nlohmann::ordered_json;

/// Returns a number as json; null if it is absent or not finite.
Json number_or_null(const std::optional<double>& x);

/// Returns the parameters of a fit as a json object {name: {value, stderr, low95, high95, identified}}.
Json parameters_as_json(const std::vector<FittedParameter>& parameters);

/// Returns a pattern that was found in the residuals of a fit, as a json object.
Json pattern_as_json(const ResidualPattern& pattern);

/// Returns the table cells of one fitted parameter, in the order value, stderr, low95, high95, identified.
std::vector<TableValue> parameter_cells(const FittedParameter& parameter);

}  // namespace floc
