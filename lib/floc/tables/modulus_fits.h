#pragma once

#include <string>
#include <vector>

#include "floc/fitting/modulus_law.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

namespace floc {

struct ModulusFitOptions {
  /// Headers of the columns of the moduli to fit. If empty, those moduli in default_moduli() are fitted of which the
  /// table contains values.
  std::vector<std::string> moduli;
  std::string branch = "first";  ///< "first": the states of the first loading; "all": all states
  double phi_limit = 1.0;        ///< see largest_solid_fraction()
};

/// Returns the names of the moduli that are fitted if the user names no moduli.
const std::vector<std::string>& default_moduli();

/// Quantity against which a modulus is fitted.
enum class ModulusAgainst { pressure, fraction };

/// Power law of one modulus, fitted to one sample.
struct ModulusFit {
  /// directory of the states or, if unknown, name of the table; "pooled" for the mean over samples
  std::string sample;
  std::string modulus;  ///< header of the column of the modulus
  ModulusAgainst against = ModulusAgainst::pressure;
  std::string unit;              ///< unit of the modulus; empty if the table has none
  std::vector<int> rows;         ///< rows of the table that were fitted
  double low = 0.0, high = 0.0;  ///< smallest and largest of the fitted pressures or solid fractions
  int n = 0;                     ///< number of states; for "pooled", number of samples
  ModulusLaw law;
};

/// Power laws of all moduli in a table of `floc moduli` or of a laboratory.
struct ModulusFits {
  std::vector<ModulusFit> fits;
  std::vector<std::string> notes;  ///< messages about rows that are not fitted
};

/// Fits power laws of elastic moduli against the pressure and, if the table has solid fractions, also against the solid
/// fraction. Consecutive rows belong to one sample if their states, in the column "file", are in the same directory;
/// without this column, all rows belong to one sample. Rows in which the pressure or the modulus is not positive are
/// left out, because these numbers have no logarithm.
/// @throws InputError with file, line and value if a column is missing or a value is not a number
ModulusFits modulus_fits(const std::string& file, const ColumnNames& columns, const ModulusFitOptions& options);

/// Returns the means of the parameters over samples, with Student's intervals: one result for each modulus and each
/// quantity against which it is fitted. The result is empty if there is only one sample.
std::vector<ModulusFit> pooled_over_samples(const std::vector<ModulusFit>& fits);

/// Returns the table of `floc fit moduli`, with a row for each parameter.
Table modulus_table(const std::vector<ModulusFit>& fits);

/// Returns a fit as the json object that `floc fit moduli --format json` prints.
Json as_json(const ModulusFit& fit);

}  // namespace floc
