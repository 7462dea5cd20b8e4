#include "floc/tables/strength_tests.h"

#include <fmt/format.h>

#include <optional>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Columns of path.csv from which the states of a test are read.
class RunColumns {
 public:
  explicit RunColumns(const CsvTable& table)
      : table_(table),
        branch_(table.column("branch")),
        control_(table.column("control")),
        axis_(table.column("axis")) {
    for (int a = 1; table.has(fmt::format("stress_{}", a)); ++a) {
      stress_.push_back(table.column(fmt::format("stress_{}", a)));
      strain_.push_back(table.column(fmt::format("strain_{}", a)));
    }
  }

  static bool are_in(const CsvTable& table) {
    return table.has("branch") && table.has("control") && table.has("axis") && table.has("stress_1") &&
           table.has("strain_1");
  }

  std::optional<TestKind> kind(int row) const {
    const std::string control = table_.text(row, control_);
    if (control == "triaxial") return TestKind::drained;
    if (control == "constant_volume") return TestKind::undrained;
    if (control == "oedometric") return TestKind::oedometer;
    return std::nullopt;
  }
  /// Whether two successive rows belong to one test. Unloading and reloading in an oedometer belong to the same test.
  bool same_test(int row, int next) const {
    const auto same = [&](int column) { return table_.text(row, column) == table_.text(next, column); };
    return same(control_) && same(axis_) && (same(branch_) || kind(row) == TestKind::oedometer);
  }
  std::size_t axis(int row) const {
    const std::int64_t axis = table_.integer(row, axis_);
    if (axis < 1 || axis > static_cast<std::int64_t>(stress_.size()))
      throw InputError(table_.place(row),
                       fmt::format("axis = {}: expected an axis from 1 to {}", axis, stress_.size()));
    return static_cast<std::size_t>(axis - 1);
  }
  ShearPoint point(int row, std::size_t axis) const {
    ShearPoint p;
    for (std::size_t a = 0; a < stress_.size(); ++a) {
      const double stress = table_.number(row, stress_[a]), strain = table_.number(row, strain_[a]);
      p.volumetric_strain += strain;
      if (a == axis) {
        p.axial_stress = stress;
        p.axial_strain = strain;
      } else {
        p.lateral_stress += stress / static_cast<double>(stress_.size() - 1);
      }
    }
    return p;
  }

 private:
  const CsvTable& table_;
  int branch_, control_, axis_;
  std::vector<int> stress_, strain_;
};

/// Subtracts the strains of the first point of a test from the strains of all its points.
void count_strains_from_start(StrengthTest& test) {
  if (test.points.empty()) return;
  const ShearPoint start = test.points.front();
  for (ShearPoint& p : test.points) {
    p.axial_strain -= start.axial_strain;
    p.volumetric_strain -= start.volumetric_strain;
  }
}

std::vector<StrengthTest> tests_of_run(const std::string& name, const CsvTable& table) {
  const RunColumns columns(table);
  std::vector<StrengthTest> tests;
  for (int row = 0; row < table.n_rows(); ++row) {
    const std::optional<TestKind> kind = columns.kind(row);
    if (!kind) continue;
    if (tests.empty() || tests.back().rows.back() != row - 1 || !columns.same_test(row - 1, row)) {
      tests.push_back({name, *kind, {}, "", {}});
      if (row > 0) tests.back().points.push_back(columns.point(row - 1, columns.axis(row)));
    }
    tests.back().rows.push_back(row);
    tests.back().points.push_back(columns.point(row, columns.axis(row)));
  }
  for (StrengthTest& test : tests) count_strains_from_start(test);
  return tests;
}

/// Returns the factor that converts a column of strains to plain ratios: 0.01 if they are in percent, otherwise 1.
/// @throws InputError for another unit
double strain_factor(const CsvTable& table, const UnitColumn& column) {
  if (column.unit == "%") return 0.01;
  if (column.unit.empty()) return 1.0;
  throw InputError(table.place(),
                   fmt::format("the column {} is in {}: expected strains without unit or in percent",
                               table.columns()[static_cast<std::size_t>(column.index)], column.unit));
}

std::vector<StrengthTest> tests_of_laboratory(const std::string& name, const NamedColumns& columns,
                                              TestKind kind) {
  const CsvTable& table = columns.table();
  const UnitColumn axial = columns.unit_column("sigma1"), lateral = columns.unit_column("sigma3");
  const double factor = unit_factor(fmt::format("{}, sigma3", name), lateral.unit, "sigma1", axial.unit);
  const bool has_strain = columns.has("strain");
  std::optional<UnitColumn> strain, volume;
  if (has_strain) {
    strain = columns.unit_column("strain");
    // An oedometer keeps the lateral lengths constant, so its volumetric strain equals its axial strain.
    volume = kind == TestKind::oedometer ? strain : columns.unit_column("volumetric_strain");
  }
  StrengthTest test{name, has_strain ? kind : TestKind::failure, {}, axial.unit, {}};
  for (int row = 0; row < table.n_rows(); ++row) {
    ShearPoint p;
    p.axial_stress = table.number(row, axial.index);
    p.lateral_stress = factor * table.number(row, lateral.index);
    if (strain) p.axial_strain = strain_factor(table, *strain) * table.number(row, strain->index);
    if (volume) p.volumetric_strain = strain_factor(table, *volume) * table.number(row, volume->index);
    test.rows.push_back(row);
    test.points.push_back(p);
  }
  count_strains_from_start(test);
  return {test};
}

}  // namespace

const char* name_of(TestKind kind) {
  switch (kind) {
    case TestKind::drained:
      return "drained";
    case TestKind::undrained:
      return "undrained";
    case TestKind::oedometer:
      return "oedometer";
    case TestKind::failure:
      break;
  }
  return "failure";
}

std::vector<StrengthTest> read_strength_tests(const std::string& file, const ColumnNames& columns,
                                              TestKind kind) {
  const CsvTable table =
      CsvTable::read(file, wanted_names({"sigma1", "sigma3", "strain", "volumetric_strain"}, columns));
  const std::string name = file == "-" ? "stdin" : file;
  return columns.empty() && RunColumns::are_in(table)
             ? tests_of_run(name, table)
             : tests_of_laboratory(name, NamedColumns(table, columns), kind);
}

}  // namespace floc
