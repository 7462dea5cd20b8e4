#pragma once

#include <string>
#include <vector>

#include "floc/fitting/shear_test.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Kind of a mechanical test, given by the quantity that is kept constant while the sample is strained along an axis.
enum class TestKind {
  drained,    ///< lateral stress constant: biaxial and triaxial tests
  undrained,  ///< volume constant, as in a saturated sample from which water cannot flow
  oedometer,  ///< lateral lengths constant
  failure,    ///< no strains: each row of the table is the state of one test at failure
};

/// Returns the name of a kind of test in tables.
const char* name_of(TestKind kind);

/// One test, whose states are consecutive rows of a table.
struct StrengthTest {
  std::string sample;  ///< name of the table
  TestKind kind = TestKind::drained;
  std::vector<int> rows;  ///< rows of the table, from 0
  std::string unit;       ///< unit of the stresses; empty if the header has none
  /// States of the test. The first one is the row before the test, if there is one; strains are measured from it.
  std::vector<ShearPoint> points;
};

/// Reads the tests in a table. In path.csv of `floc run`, a test consists of consecutive rows with the same driven axis
/// and the control triaxial, constant_volume or oedometric. Any other table has the columns sigma1 and sigma3 (stresses
/// along the axis and across it). If it also has the columns strain (along the axis) and volumetric_strain, the table
/// is one test. If it has neither, each row is a sample at failure.
/// @param kind     kind of the test in a table with strains that was not written by `floc run`
/// @param columns  headers of columns that have other names in the table
/// @throws InputError with file, line and value if a column is missing or a value is not a number
std::vector<StrengthTest> read_strength_tests(const std::string& file, const ColumnNames& columns,
                                              TestKind kind = TestKind::drained);

}  // namespace floc
