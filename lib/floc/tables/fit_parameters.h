#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/io/table.h"

namespace floc {

using Json = nlohmann::ordered_json;

/// null for a number that is absent or not finite.
Json number_or_null(const std::optional<double>& x);

/// {name: {value, stderr, low95, high95, identified}}.
Json parameters_as_json(const std::vector<FittedParameter>& parameters);

/// Cells value, stderr, low95, high95, identified of one parameter.
std::vector<TableValue> parameter_cells(const FittedParameter& parameter);

}  // namespace floc
