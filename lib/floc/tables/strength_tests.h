#pragma once

#include <string>
#include <vector>

#include "floc/fitting/shear_test.h"
#include "floc/fitting/simple_shear_test.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Kind of a mechanical test, given by the quantity that is kept constant while the sample is strained along an axis.
enum class TestKind {
  drained,       ///< the lateral stress: biaxial and triaxial tests
  undrained,     ///< the volume, as in a saturated sample whose water cannot flow
  oedometer,     ///< the lateral lengths
  simple_shear,  ///< the stress across planes that are sheared along each other
  failure,       ///< rows of a table that gives one state of failure for each test
};

/// Returns the name of a kind of test in tables.
const char* name_of(TestKind kind);

/// Returns the kind of test with the given word; drained tests if there is none.
TestKind kind_of_test(const std::string& word);

/// One test, whose states are consecutive rows of a table.
struct StrengthTest {
  std::string sample;  ///< name of the table
  TestKind kind = TestKind::drained;
  std::vector<int> rows;  ///< rows of the table, from 0
  std::string unit;       ///< unit of the stresses; empty if the header has none
  /// States of the test. The first one is the row before the test, if there is one; strains are measured from it.
  std::vector<ShearPoint> points;
  std::vector<PlaneShearPoint>
      planes;  ///< states of a test of simple shear, or of one whose failure is on given planes

  std::size_t n_states() const { return points.size() + planes.size(); }
};

/// Returns the tables that an argument of `floc fit strength` stands for: those of tables_of() or, for the directory of a
/// campaign, those of the runs of all of its cases.
std::vector<std::string> tables_of_tests(const std::string& input);

/// Names of the quantities of tables of tests.
const std::vector<std::string>& strength_names();

/// Reads the tests in a table. In path.csv of `floc run` these are the consecutive rows with one driven axis and the
/// control triaxial, constant_volume, oedometric or simple_shear. Any other table has the columns sigma1 and sigma3 (stresses along
/// the axis and across it) and either strain (along the axis) and volumetric_strain, and is one test, or
/// neither, and each row is a sample at failure. A table of simple shear has sigma_n and tau (stresses across and along the
/// planes) in their place, and shear_strain in that of strain.
/// @param kind     kind of the test in a table with strains that `floc run` has not written
/// @param columns  headers of the columns, for quantities whose columns have other headers
/// @throws InputError with file, line and value if a column is missing or a value is not a number
std::vector<StrengthTest> read_strength_tests(const std::string& file, const ColumnNames& columns,
                                              TestKind kind = TestKind::drained);

}  // namespace floc
