#pragma once

#include <string>
#include <vector>

#include "floc/fitting/shear_test.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Kind of a mechanical test by what is kept while the sample is strained along an axis.
enum class TestKind {
  drained,    ///< the lateral stress: biaxial and triaxial tests
  undrained,  ///< the volume, as in a saturated sample whose water cannot flow
  oedometer,  ///< the lateral lengths
  failure,    ///< rows of a table that gives one state of failure for each test
};

/// Returns the word of a kind of test in tables.
const char* name_of(TestKind kind);

/// One test, as consecutive rows of a table.
struct StrengthTest {
  std::string sample;  ///< name of the table
  TestKind kind = TestKind::drained;
  std::vector<int> rows;  ///< rows of the table, from 0
  std::string unit;       ///< unit of the stresses; empty if the header has none
  /// States of the test. The first is the row before the test, if there is one: strains count from it.
  std::vector<ShearPoint> points;
};

/// Reads the tests in a table. In path.csv of `floc run` these are the consecutive rows with one driven axis and the
/// control triaxial, constant_volume or oedometric. Any other table has the columns sigma1 and sigma3 (stresses along
/// the axis and across it) and either strain (along the axis) and volumetric_strain, and is one test, or
/// neither, and each row is a sample at failure.
/// @param kind     kind of the test in a table with strains that `floc run` has not written
/// @param columns  headers of the columns, for quantities whose columns have other headers
/// @throws InputError with file, line and value if a column is missing or a value is not a number
std::vector<StrengthTest> read_strength_tests(const std::string& file, const ColumnNames& columns,
                                              TestKind kind = TestKind::drained);

}  // namespace floc
