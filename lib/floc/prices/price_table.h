#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/prices/numerical_settings.h"

namespace floc {

/// Price of one numerical setting: its cost, and the error that it causes in one observable (such as the solid
/// fraction). A PriceRow is one row of the table that `floc tradeoff` writes. Errors are relative. A number that the
/// table lacks is NaN.
struct PriceRow {
  /// name and value of the parameter that was varied, e.g. "time_step" and "0.2"
  std::string parameter, value;
  NumericalSettings settings;
  std::string observable;
  std::string unit;     ///< unit of the observable; empty if the table has no units
  double cost_ratio;    ///< processor time divided by the processor time with the strictest settings
  double core_seconds;  ///< processor time of a sample (s)
  double memory_mb;     ///< largest memory of a run (MB), not including the memory of the program itself
  double error;         ///< error that 95 % of the states do not exceed; NaN if no states were compared
  /// Mean relative difference of the observable from its value with the strictest settings; NaN if no means were
  /// compared. The mean is over samples and over the states after a collapse (a sudden rearrangement of grains).
  double mean_difference;
  double mean_stderr;  ///< standard error of mean_difference
  double mean_error;   ///< half width of the 95 % confidence interval of mean_difference
  /// Standard deviation of a quantity between samples, divided by the mean of the quantity. The quantity is the mean of
  /// the observable over the states of a sample, or a parameter fitted to the path of a sample.
  double sample_scatter;
  double reference_value;  ///< mean of the observable with the strictest settings
  int n_grains;            ///< number of grains of a sample; 0 if the table does not contain it
  int n_samples;           ///< number of samples; 0 if the table does not contain it
  int n_states;            ///< number of states (equilibria) of a sample; 0 if the table does not contain it
  /// stiffness number a K_N/F0 of the scene on which the price was measured (a largest diameter, K_N normal stiffness,
  /// F0 pull-off force); for cohesive grains only
  double kappa;
};

/// Prices of numerical settings for one kind of scenes (floc/scene/scene_kind.h).
struct PriceTable {
  std::string place;  ///< name of the file of the table
  bool is_shipped = false;
  std::string kind;  ///< empty for a table of an early version of floc, which does not contain it
  std::vector<PriceRow> rows;

  /// Returns the name of the table for messages: "table shipped with floc" or "table FILE".
  std::string name() const { return is_shipped ? "table shipped with floc" : "table " + place; }
  /// Returns the row for an observable and a value of a parameter; null if there is none.
  const PriceRow* find(const std::string& parameter, const std::string& value,
                       const std::string& observable) const;
  /// Returns the rows for an observable and a parameter, in the order of the table.
  std::vector<const PriceRow*> find_all(const std::string& parameter, const std::string& observable) const;
  /// Whether the table describes scenes of rigid grains.
  bool is_of_rigid_grains() const { return kind.starts_with("rigid"); }
  /// Returns the names of the observables in the table, each once, in the order of their first rows.
  std::vector<std::string> observables() const;
};

/// Returns the number at the beginning of the value of a parameter, such as 10 of "10 times"; NaN if there is none.
double leading_number(const std::string& value);

/// Version of the tables that this version of floc writes (column "version") and reads. It changes when columns change
/// their meaning.
inline constexpr int kPriceTableVersion = 1;

/// Reads a table that `floc tradeoff` has written in CSV format. Its columns are found by their names.
/// @param csv  text of the table
/// @param place  name of the table, for messages
/// @throws InputError if the table lacks a column that every version of `floc tradeoff` writes, if a value is not a
/// number, if the table is of another version (kPriceTableVersion), or if the rows describe scenes of different kinds
PriceTable read_price_table(const std::string& csv, const std::string& place);

/// Returns the path of the folder with the tables KIND.csv that are shipped with the program. The folder is
/// share/floc/tables/tradeoff, relative to a folder above the program or above the library that contains this code.
/// @throws InputError if there is no such folder
std::string price_folder();

/// Returns the kinds of scenes for which a table is shipped, in alphabetic order.
/// @throws InputError if there is no folder of tables
std::vector<std::string> priced_kinds();

/// Returns the table for one kind of scenes; no value if no table is shipped for this kind.
/// @throws InputError if there is no folder of tables, or if the table is not valid
std::optional<PriceTable> shipped_prices(const std::string& kind);

}  // namespace floc
