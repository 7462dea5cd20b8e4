#pragma once

#include <string>
#include <vector>

#include "floc/fitting/modulus_law.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

namespace floc {

struct ModulusFitOptions {
  /// Headers of the columns of the moduli; empty for those of default_moduli() that the table has.
  std::vector<std::string> moduli;
  std::string branch = "first";  ///< "first": the states of the first loading; "all": all states
  double phi_limit = 1.0;        ///< see largest_solid_fraction()
};

/// Names of the moduli that are fitted where the user names none.
const std::vector<std::string>& default_moduli();

/// Quantity against which a modulus is fitted.
enum class ModulusAgainst { pressure, fraction };

/// Power law of one modulus of one sample.
struct ModulusFit {
  std::string sample;   ///< directory of the states, otherwise the table; "pooled" for the mean over samples
  std::string modulus;  ///< header of the column of the modulus
  ModulusAgainst against = ModulusAgainst::pressure;
  std::string unit;              ///< unit of the modulus; empty if the table has none
  std::vector<int> rows;         ///< rows of the table that were fitted
  double low = 0.0, high = 0.0;  ///< smallest and largest pressure or solid fraction
  int n = 0;                     ///< number of states, or of samples
  ModulusLaw law;
};

/// Moduli of samples as a table of `floc moduli`, or a laboratory, gives them.
struct ModulusFits {
  std::vector<ModulusFit> fits;
  std::vector<std::string> notes;  ///< messages about rows that do not count
};

/// Fits power laws of elastic moduli against the pressure and, where the table has solid fractions, against these.
/// Consecutive rows whose states, in the column "file", are in one directory are one sample; without this column the table
/// is one sample. States without pressure or with a modulus that is not positive have no logarithm and are left out.
/// @throws InputError with file, line and value if a column is missing or a value is not a number
ModulusFits modulus_fits(const std::string& file, const ColumnNames& columns, const ModulusFitOptions& options);

/// Returns the means of the parameters over samples, for each modulus and each quantity, with Student's interval. There
/// are none if there is a single sample.
std::vector<ModulusFit> pooled_over_samples(const std::vector<ModulusFit>& fits);

/// Returns the table of `floc fit moduli`, with a row for each parameter.
Table modulus_table(const std::vector<ModulusFit>& fits);

/// Returns a fit as the json object that `floc fit moduli --format json` prints.
Json as_json(const ModulusFit& fit);

}  // namespace floc
