#include "floc/tables/strength_tests.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

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
    if (control == "simple_shear") return TestKind::simple_shear;
    return std::nullopt;
  }
  /// Returns whether two successive rows belong to the same test. Unloading and reloading in an oedometer belong to the
  /// same test as the loading.
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

  /// Returns the strain along the driven axis or, in simple shear, the shear strain of the stage of a row.
  double strain(int row, std::size_t axis) const {
    return table_.number(row,
                         kind(row) == TestKind::simple_shear ? table_.column("shear_strain") : strain_[axis]);
  }
  /// Returns the strain along the driven axis in the row before a row, which need not belong to the same test.
  double strain_before(int row, std::size_t axis) const { return table_.number(row - 1, strain_[axis]); }

  /// Returns the state in a row of a test of simple shear, without its shear strain.
  /// @param of  a row of the test: `row` itself, or the first row if `row` is the row before the test, which has a
  /// shear stress if it belongs to a test on the same planes
  PlaneShearPoint plane(int row, int of) const {
    const std::size_t axis = this->axis(of);
    PlaneShearPoint p;
    p.normal_stress = table_.number(row, stress_[axis]);
    for (const int column : strain_) p.volumetric_strain += table_.number(row, column);
    if (kind(row) == TestKind::simple_shear && this->axis(row) == axis)
      p.shear_stress = table_.number(row, table_.column("shear_stress"));
    return p;
  }

 private:
  const CsvTable& table_;
  int branch_, control_, axis_;
  std::vector<int> stress_, strain_;
};

/// Subtracts the strains of the first point of a test from the strains of all its points.
void count_strains_from_start(StrengthTest& test) {
  const ShearPoint start = test.points.empty() ? ShearPoint{} : test.points.front();
  for (ShearPoint& p : test.points) {
    p.axial_strain -= start.axial_strain;
    p.volumetric_strain -= start.volumetric_strain;
  }
  const PlaneShearPoint of_planes = test.planes.empty() ? PlaneShearPoint{} : test.planes.front();
  for (PlaneShearPoint& p : test.planes) {
    p.shear_strain -= of_planes.shear_strain;
    p.volumetric_strain -= of_planes.volumetric_strain;
  }
}

/// Adds the state in the row `row` to `test`.
/// @param of  a row of the test: `row` itself or, if `row` is the row before the test, the first row of the test
void add_state(const RunColumns& columns, int row, int of, StrengthTest& test) {
  if (test.kind == TestKind::simple_shear)
    test.planes.push_back(columns.plane(row, of));
  else
    test.points.push_back(columns.point(row, columns.axis(of)));
}

/// Strain of a test from its first state on, row by row.
class StrainOfTest {
 public:
  /// Returns the strain that a row adds to the strain of the row before. The shear strains of simple shear begin at
  /// zero in each stage, and grow by equal steps.
  double step(const RunColumns& columns, int row, std::size_t axis) {
    const double now = columns.strain(row, axis);
    if (columns.kind(row) != TestKind::simple_shear)
      return row > 0 ? now - columns.strain_before(row, axis) : 0.0;
    const bool goes_on = std::abs(now - of_stage_ - stage_step_) <= kNoise * std::abs(now);
    if (!goes_on) stage_step_ = now;
    const double added = goes_on ? stage_step_ : now;
    of_stage_ = now;
    return added;
  }
  /// Returns whether a step clearly takes back a part of the strain. Steps under a constant stress may be of the size
  /// of the errors of an equilibrium.
  bool reverses(double step) const {
    return std::abs(furthest_) > kNoise && step * furthest_ < 0.0 &&
           std::abs(furthest_ - strain_ - step) > kClear * std::abs(furthest_);
  }
  void add(double step) {
    strain_ += step;
    if (std::abs(strain_) > std::abs(furthest_)) furthest_ = strain_;
  }
  /// Begins a new test.
  void restart() { strain_ = furthest_ = 0.0; }
  double strain() const { return strain_; }

 private:
  static constexpr double kNoise = 1e-7;  ///< strain below which a strain may be an error of an equilibrium
  static constexpr double kClear = 1e-3;  ///< share of the strain of a test that a reversal takes back at least
  double strain_ = 0.0, furthest_ = 0.0;
  double of_stage_ = 0.0,
         stage_step_ = 0.0;  ///< shear strain of the last row, and of the first row of its stage
};

/// Reads the tests of a run. Except in an oedometer, a test ends where the strain reverses.
std::vector<StrengthTest> tests_of_run(const std::string& name, const CsvTable& table) {
  const RunColumns columns(table);
  std::vector<StrengthTest> tests;
  StrainOfTest strain;
  for (int row = 0; row < table.n_rows(); ++row) {
    const std::optional<TestKind> kind = columns.kind(row);
    if (!kind) continue;
    const std::size_t axis = columns.axis(row);
    const bool goes_on =
        !tests.empty() && tests.back().rows.back() == row - 1 && columns.same_test(row - 1, row);
    if (!goes_on) strain = StrainOfTest();
    const double step = strain.step(columns, row, axis);
    const bool is_reversal = goes_on && kind != TestKind::oedometer && strain.reverses(step);
    if (!goes_on || is_reversal) {
      strain.restart();
      tests.push_back({.sample = name, .kind = *kind, .is_reversal = is_reversal});
      if (row > 0) add_state(columns, row - 1, row, tests.back());
    }
    strain.add(step);
    tests.back().rows.push_back(row);
    add_state(columns, row, row, tests.back());
    if (kind == TestKind::simple_shear) tests.back().planes.back().shear_strain = strain.strain();
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

/// Column of strains, with the factor that converts its numbers to plain ratios.
struct StrainColumn {
  int index;
  double factor;
};

StrainColumn strain_column(const NamedColumns& columns, const std::string& name) {
  const UnitColumn column = columns.unit_column(name);
  return {column.index, strain_factor(columns.table(), column)};
}

/// Returns whether a table contains stresses on planes that slide along each other.
bool is_of_planes(const NamedColumns& columns, TestKind kind) {
  return kind == TestKind::simple_shear || (!columns.has("sigma1") && columns.has("tau"));
}

std::vector<StrengthTest> tests_on_planes(const std::string& name, const NamedColumns& columns) {
  const CsvTable& table = columns.table();
  const UnitColumn normal = columns.unit_column("sigma_n"), shear = columns.unit_column("tau");
  const double factor = unit_factor(fmt::format("{}, tau", name), shear.unit, "sigma_n", normal.unit);
  std::optional<StrainColumn> strain, volume;
  if (columns.has("shear_strain")) {
    strain = strain_column(columns, "shear_strain");
    volume = strain_column(columns, "volumetric_strain");
  }
  StrengthTest test{
      .sample = name, .kind = strain ? TestKind::simple_shear : TestKind::failure, .unit = normal.unit};
  for (int row = 0; row < table.n_rows(); ++row) {
    PlaneShearPoint p;
    p.normal_stress = table.number(row, normal.index);
    p.shear_stress = factor * table.number(row, shear.index);
    if (strain) p.shear_strain = strain->factor * table.number(row, strain->index);
    if (volume) p.volumetric_strain = volume->factor * table.number(row, volume->index);
    test.rows.push_back(row);
    test.planes.push_back(p);
  }
  count_strains_from_start(test);
  return {test};
}

std::vector<StrengthTest> tests_of_laboratory(const std::string& name, const NamedColumns& columns,
                                              TestKind kind) {
  const CsvTable& table = columns.table();
  const UnitColumn axial = columns.unit_column("sigma1"), lateral = columns.unit_column("sigma3");
  const double factor = unit_factor(fmt::format("{}, sigma3", name), lateral.unit, "sigma1", axial.unit);
  std::optional<StrainColumn> strain, volume;
  if (columns.has("strain")) {
    strain = strain_column(columns, "strain");
    // In an oedometer, the lateral lengths are constant. Therefore the volumetric strain equals the axial strain. The
    // volume of an undrained test is constant, so that its table need not have this column.
    if (kind == TestKind::oedometer)
      volume = strain;
    else if (kind != TestKind::undrained || columns.has("volumetric_strain"))
      volume = strain_column(columns, "volumetric_strain");
  }
  StrengthTest test{.sample = name, .kind = strain ? kind : TestKind::failure, .unit = axial.unit};
  for (int row = 0; row < table.n_rows(); ++row) {
    ShearPoint p;
    p.axial_stress = table.number(row, axial.index);
    p.lateral_stress = factor * table.number(row, lateral.index);
    if (strain) p.axial_strain = strain->factor * table.number(row, strain->index);
    if (volume) p.volumetric_strain = volume->factor * table.number(row, volume->index);
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
    case TestKind::simple_shear:
      return "simple-shear";
    case TestKind::failure:
      break;
  }
  return "failure";
}

namespace {

/// Returns whether the directory of a case of a campaign contains the load path of at least one run.
bool has_path(const std::filesystem::path& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (std::filesystem::exists(entry.path() / "path.csv")) return true;
  return false;
}

}  // namespace

TestKind kind_of_test(const std::string& word) {
  for (const TestKind kind : {TestKind::undrained, TestKind::oedometer, TestKind::simple_shear})
    if (word == name_of(kind)) return kind;
  return TestKind::drained;
}

const std::vector<std::string>& strength_names() {
  static const std::vector<std::string> names = {"sigma1",  "sigma3", "strain",      "volumetric_strain",
                                                 "sigma_n", "tau",    "shear_strain"};
  return names;
}

std::vector<std::string> tables_of_tests(const std::string& input) {
  namespace fs = std::filesystem;
  const fs::path runs = fs::path(input) / "runs";
  if (input == "-" || !fs::is_directory(runs)) return tables_of(input);
  std::set<std::string> cases;
  for (const auto& entry : fs::directory_iterator(runs))
    if (entry.is_directory() && has_path(entry.path())) cases.insert(entry.path().string());
  std::vector<std::string> tables;
  for (const std::string& one : cases)
    for (std::string& table : tables_of(one)) tables.push_back(std::move(table));
  return tables;
}

std::vector<StrengthTest> read_strength_tests(const std::string& file, const ColumnNames& columns,
                                              TestKind kind) {
  const CsvTable table = CsvTable::read(file, wanted_names(strength_names(), columns));
  const std::string name = file == "-" ? "stdin" : file;
  if (columns.empty() && RunColumns::are_in(table)) return tests_of_run(name, table);
  const NamedColumns named(table, columns);
  return is_of_planes(named, kind) ? tests_on_planes(name, named) : tests_of_laboratory(name, named, kind);
}

}  // namespace floc
