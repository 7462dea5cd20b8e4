#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Returns the mean of independent values, such as those of several samples, with its interval by Student's t.
/// A single value has no interval.
FittedParameter mean_of_samples(const std::string& name, const std::vector<double>& values);

/// Returns the mean of successive correlated values, such as those along the path of one sample. Its interval follows
/// from the means of five successive batches of equal length, which are treated as independent. The correlation length
/// must therefore be shorter than one batch. With fewer than ten values there is no interval.
FittedParameter mean_along_path(const std::string& name, const std::vector<double>& values);

}  // namespace floc
