#pragma once

#include <string>
#include <vector>

#include "floc/fitting/shear_test.h"
#include "floc/fitting/simple_shear_test.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Kind of a mechanical test. The kinds differ in the quantity that is constant while the sample is strained along an
/// axis.
enum class TestKind {
  drained,       ///< lateral stress constant: biaxial and triaxial tests
  undrained,     ///< volume constant, as in a saturated sample whose water cannot flow
  oedometer,     ///< lateral lengths constant
  simple_shear,  ///< normal stress constant, on planes that slide along each other
  failure,       ///< table in which each row is a test: its state at failure
};

/// Returns the name that tables use for a kind of test.
const char* name_of(TestKind kind);

/// Returns the kind of test with the given name; TestKind::drained if no kind has this name.
TestKind kind_of_test(const std::string& word);

/// One test, whose states are consecutive rows of a table.
struct StrengthTest {
  std::string sample;  ///< name of the table
  TestKind kind = TestKind::drained;
  std::vector<int> rows = {};  ///< rows of the table, from 0
  std::string unit = {};       ///< unit of the stresses; empty if the header has none
  /// States of the test. The first state is the row before the test, if the table has such a row. Strains are measured
  /// from the first state.
  std::vector<ShearPoint> points = {};
  /// states of a test of simple shear, or of another test whose table gives the stresses on the failure planes
  std::vector<PlaneShearPoint> planes = {};

  /// Whether the test strains its sample back after the test before. The sample is then not in its state before all
  /// tests.
  bool is_reversal = false;

  std::size_t n_states() const { return points.size() + planes.size(); }
};

/// Returns the files of the tables that an argument of `floc fit strength` denotes: for the directory of a campaign,
/// the tables of the runs of all its cases; otherwise the result of tables_of().
std::vector<std::string> tables_of_tests(const std::string& input);

/// Returns the names of the quantities that tables of tests may contain.
const std::vector<std::string>& strength_names();

/// Reads the tests in a table. In path.csv of `floc run`, a test consists of consecutive rows with the same driven axis
/// and the same control (triaxial, constant_volume, oedometric or simple_shear). Any other table has the columns sigma1
/// and sigma3 (stresses along the axis and across it). If this table also has the columns strain (along the axis) and
/// volumetric_strain, all its rows are one test. Without these columns, each row is a sample at failure. A table of
/// simple shear has the columns sigma_n and tau (normal and shear stress on the planes) instead of sigma1 and sigma3,
/// and shear_strain instead of strain.
/// @param kind     kind of the test in a table with strains that was not written by `floc run`
/// @param columns  headers of those columns whose header differs from the name of their quantity
/// @throws InputError with file, line and value if a column is missing or a value is not a number
std::vector<StrengthTest> read_strength_tests(const std::string& file, const ColumnNames& columns,
                                              TestKind kind = TestKind::drained);

}  // namespace floc
