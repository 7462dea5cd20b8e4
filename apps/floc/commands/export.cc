#include "commands/export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "floc/base/error.h"
#include "floc/base/shell_word.h"
#include "floc/io/law_text.h"
#include "floc/packing/body_name.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/wall_forces.h"
#include "floc/tables/column.h"
#include "process/output.h"

namespace floc {
namespace {

struct ExportArguments {
  std::string state;
  /// Names of the csv files to write; a file with an empty name is not written.
  std::string grains, contacts, shapes;
};

constexpr const char* kAxes[] = {"x", "y", "z"};

/// Names of the columns for the orientation of a grain: in 2D an angle (radians), in 3D the components of a unit
/// quaternion with the real component last.
template <int Dim>
const std::vector<std::string> kOrientation =
    Dim == 2 ? std::vector<std::string>{"angle"} : std::vector<std::string>{"qx", "qy", "qz", "qw"};

void add_orientation(double angle, std::vector<TableValue>& row) {
  row.emplace_back(angle);
}
void add_orientation(const Eigen::Quaterniond& q, std::vector<TableValue>& row) {
  for (const double component : {q.x(), q.y(), q.z(), q.w()}) row.emplace_back(component);
}

template <int Dim>
Table grain_table(const Packing<Dim>& packing) {
  const Grains<Dim>& grains = packing.grains;
  const bool exact = !grains.position_low.empty();
  Table table{{"id"}, {}};
  for (const char* part : {"", "_low"})
    for (int a = 0; a < Dim; ++a)
      if (part[0] == '\0' || exact) table.columns.push_back(std::string(kAxes[a]) + part);
  table.columns.insert(table.columns.end(), {"radius", "mass"});
  if (!grains.are_round()) {
    table.columns.insert(table.columns.end(), {"shape", "scale"});
    table.columns.insert(table.columns.end(), kOrientation<Dim>.begin(), kOrientation<Dim>.end());
  }
  for (int i = 0; i < grains.size(); ++i) {
    auto& row = table.rows.emplace_back();
    row.emplace_back(grains.name(i));
    for (int a = 0; a < Dim; ++a) row.emplace_back(grains.position[i][a]);
    for (int a = 0; a < Dim && exact; ++a) row.emplace_back(grains.position_low[i][a]);
    row.emplace_back(grains.radius[i]);
    row.emplace_back(grains.mass[i]);
    if (grains.are_round()) continue;
    row.push_back(count(grains.shape[i]));
    row.emplace_back(grains.scale[i]);
    add_orientation(grains.orientation[i], row);
  }
  return table;
}

/// Returns a table of the vertices of all shapes. The coordinates of a vertex are along the axes of its shape and
/// relative to the centre of mass of the shape. A disk or sphere, which has no vertices, has one row for its centre.
template <int Dim>
Table shape_table(const Packing<Dim>& packing) {
  Table table{{"shape", "vertex"}, {}};
  for (int a = 0; a < Dim; ++a) table.columns.emplace_back(kAxes[a]);
  table.columns.emplace_back("rounding");
  for (int s = 0; s < static_cast<int>(packing.grains.shapes->size()); ++s) {
    const Shape<Dim>& shape = (*packing.grains.shapes)[static_cast<std::size_t>(s)];
    std::vector<Vec<Dim>> vertices = shape.vertices;
    if (vertices.empty()) vertices.push_back(Vec<Dim>::Zero());
    for (int v = 0; v < static_cast<int>(vertices.size()); ++v) {
      auto& row = table.rows.emplace_back(std::vector<TableValue>{count(s), count(v)});
      for (const double x : vertices[static_cast<std::size_t>(v)]) row.emplace_back(x);
      row.emplace_back(shape.rounding);
    }
  }
  return table;
}

/// Returns the names of the strengths that at least one contact has, each with its index in kStrengthNames.
std::vector<std::pair<std::string, std::size_t>> given_strengths(const std::vector<Strengths>& strengths) {
  std::vector<std::pair<std::string, std::size_t>> given;
  for (std::size_t k = 0; k < kStrengthNames.size(); ++k)
    if (std::any_of(strengths.begin(), strengths.end(), [&](const Strengths& s) { return s[k] > 0.0; }))
      given.emplace_back(kStrengthNames[k], k);
  return given;
}

/// Appends the point, normal, gap and kind of a contact between grains with corners to the row of this contact.
template <int Dim>
void add_point(const Packing<Dim>& packing, const Contact<Dim>& c, std::vector<TableValue>& row) {
  const Vec<Dim> point = packing.grains.position[c.i] + c.arm_i;
  for (int a = 0; a < Dim; ++a) row.emplace_back(point[a]);
  for (int a = 0; a < Dim; ++a) row.emplace_back(c.normal[a]);
  row.emplace_back(c.gap);
  row.emplace_back(contact_type_name(c.type));
}

/// Returns the table of the contacts. The table has columns for rolling moments only if the contact law or bonds can
/// resist rolling, and columns for twisting moments only if they can resist twisting: otherwise `floc convert` would
/// reject the moments.
template <int Dim>
Table contact_table(const State<Dim>& state) {
  const Packing<Dim>& packing = state.packing;
  const bool bonds = std::any_of(packing.contacts.begin(), packing.contacts.end(),
                                 [](const Contact<Dim>& c) { return c.bonded; });
  const bool rolls = packing.law.has_rolling() || bonds;
  const bool twists = packing.law.has_twisting() || (bonds && Dim == 3);
  const std::vector<Strengths> strengths = strengths_by_contact(packing.contacts, state.bond_strengths);
  const auto given = given_strengths(strengths);
  Table table{{"id1", "id2"}, {}};
  const auto numbered = [&table](const char* name, int n) {
    for (int a = 1; a <= n; ++a) table.columns.push_back(fmt::format("{}{}", name, a));
  };
  // The columns have the names that `floc convert --contacts` expects, so that floc can read the table again. In 2D the
  // rolling moment is a scalar, so the name of its column has no index at the end.
  numbered("image", Dim);
  table.columns.emplace_back("normal_force");
  numbered("shear_force", Dim);
  if (rolls && Dim == 2) table.columns.emplace_back("rolling_moment");
  if (rolls && Dim == 3) numbered("rolling_moment", Dim);
  if (twists) table.columns.emplace_back("twisting_moment");
  const bool stiff = !packing.law.is_rigid();
  if (stiff) table.columns.insert(table.columns.end(), {"kn", "kt"});
  if (rolls) table.columns.emplace_back("kr");
  if (holds_liquid(packing)) table.columns.emplace_back("bridge_volume");
  const bool has_points = !packing.grains.are_round();
  if (has_points) {
    numbered("point", Dim);
    numbered("normal", Dim);
    table.columns.insert(table.columns.end(), {"gap", "kind"});
  }
  if (bonds) table.columns.emplace_back("bonded");
  if (bonds && Dim == 3) table.columns.emplace_back("ktw");
  for (const auto& [name, k] : given) table.columns.push_back(name);
  for (std::size_t at = 0; at < packing.contacts.size(); ++at) {
    const Contact<Dim>& c = packing.contacts[at];
    auto& row = table.rows.emplace_back();
    row.emplace_back(packing.grains.name(c.i));
    if (packing.is_wall(c.j))
      row.emplace_back(body_name(packing, c.j));
    else
      row.emplace_back(packing.grains.name(c.j));
    for (int a = 0; a < Dim; ++a) row.push_back(count(c.image[a]));
    row.emplace_back(c.normal_force);
    for (int a = 0; a < Dim; ++a) row.emplace_back(c.shear_force[a]);
    for (int a = 0; a < kRotations<Dim> && rolls; ++a) row.emplace_back(c.rolling_moment[a]);
    if (twists) row.emplace_back(c.twisting_moment);
    if (stiff) row.emplace_back(c.kn), row.emplace_back(c.kt);
    if (rolls) row.emplace_back(c.kr);
    if (holds_liquid(packing)) row.emplace_back(bridge_volume(packing, c));
    if (has_points) add_point(packing, c, row);
    if (bonds) row.push_back(count(c.bonded ? 1 : 0));
    if (bonds && Dim == 3) row.emplace_back(c.ktw);
    for (const auto& [name, k] : given) row.emplace_back(strengths[at][k]);
  }
  return table;
}

/// Returns the options of `floc convert` for the walls and the body force of a packing; empty if the packing has
/// neither.
template <int Dim>
std::string boundary_options(const Packing<Dim>& packing) {
  std::string walls, options;
  for (std::size_t w = 0; w + 1 < packing.walls.size(); w += 2) {
    const auto place = [](const Wall<Dim>& wall) {
      return wall.open ? std::string() : fmt::format("{}", wall.position);
    };
    walls += fmt::format("{}{}={}:{}", walls.empty() ? "" : ",", kAxes[packing.walls[w].axis],
                         place(packing.walls[w]), place(packing.walls[w + 1]));
  }
  if (!walls.empty()) options = fmt::format(" --walls {} --wall-law '{}'", walls, law_text(packing.wall_law));
  std::string masses;
  for (const Wall<Dim>& wall : packing.walls)
    if (!wall.open && follows_forces(wall))
      masses += fmt::format("{}{}{}={}", masses.empty() ? "" : ",", kAxes[wall.axis], wall.side < 0 ? "-" : "+",
                            wall.mass);
  if (!masses.empty()) options += " --wall-masses " + masses;
  if (!packing.gravity.isZero(0.0))
    options += fmt::format(" --gravity={}", fmt::join(packing.gravity.begin(), packing.gravity.end(), ","));
  return options;
}

/// Returns the command line of `floc convert` that restores the state from the table of grains and the table of
/// contacts. The options give the quantities that neither table contains: cell, contact law, stress, units and
/// tolerance.
template <int Dim>
std::string convert_command(const ExportArguments& arguments, const State<Dim>& state) {
  std::vector<std::string> vectors;
  for (int a = 0; a < Dim; ++a) {
    const auto row = state.packing.cell.matrix.row(a);
    vectors.push_back(fmt::format("{}", fmt::join(row.begin(), row.end(), ",")));
  }
  const bool named_csv = std::filesystem::path(arguments.grains).extension() == ".csv";
  return fmt::format(
      "floc convert {} STATE.h5{} --cell '{}'{} --law '{}' --stress={} --units {} --tolerance {} --contacts {}",
      shell_word(arguments.grains), named_csv ? "" : " --from csv", fmt::join(vectors, ";"),
      boundary_options(state.packing), law_text(state.packing.law),
      fmt::join(state.target_stress.begin(), state.target_stress.end(), ","), state.units,
      state.tolerance.force, shell_word(arguments.contacts));
}

template <int Dim>
void export_state(const ExportArguments& arguments, const State<Dim>& state) {
  const bool both = !arguments.grains.empty() && !arguments.contacts.empty();
  if (!arguments.grains.empty()) write_csv(arguments.grains, grain_table(state.packing));
  if (!arguments.contacts.empty()) write_csv(arguments.contacts, contact_table(state));
  if (!arguments.shapes.empty()) write_csv(arguments.shapes, shape_table(state.packing));
  if (!state.packing.grains.are_round())
    spdlog::info(
        "floc convert cannot read grains with corners from tables of grains; Packing.from_arrays of the Python "
        "package can{}",
        Dim == 3
            ? fmt::format(", and floc convert {} FILE.conf writes the packing for Rockable if its shapes are "
                          "rounded and all axes are periodic or all have walls",
                          shell_word(arguments.state))
            : "");
  if (!both || !state.packing.grains.are_round()) return;
  spdlog::info("wrote {} grains and {} contacts. The following command restores the state:\n  {}",
               state.packing.grains.size(), state.packing.contacts.size(), convert_command(arguments, state));
}

int run_export(const ExportArguments& arguments) {
  if (arguments.grains.empty() && arguments.contacts.empty() && arguments.shapes.empty())
    throw InputError("floc export", "no output file is named: give --grains FILE, --contacts FILE or both");
  return for_each_file({arguments.state}, [&](const std::string& file) {
    std::visit(
        [&](const auto& state) {
          if (!arguments.shapes.empty() && state.packing.grains.are_round())
            throw InputError(file, "all grains are disks or spheres, which have no vertices: omit --shapes");
          export_state(arguments, state);
        },
        read_state(file));
    return int{kDone};
  });
}

}  // namespace

Command add_export(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "export", "Write the grains and contacts of a state to csv files that floc convert can read");
  auto arguments = std::make_shared<ExportArguments>();
  app.add_option("STATE", arguments->state, "state file, or - for a state on stdin").required();
  app.add_option(
      "--grains", arguments->grains,
      "csv file to write, with one row per grain: position, radius, mass; of grains with corners also "
      "shape, scale and orientation");
  app.add_option("--contacts", arguments->contacts,
                 "csv file to write, with one row per contact: forces, moments, stiffnesses; of grains with "
                 "corners also point, normal, gap and kind");
  app.add_option("--shapes", arguments->shapes,
                 "of grains with corners: csv file to write, with one row per vertex of each shape");
  app.footer(
      "If both files are written, floc prints the command that restores the state from them. This command "
      "contains the\ncell, walls, contact law and load, which are not in the tables. Velocities, angles and "
      "the "
      "history of "
      "the run are not written.");
  return {app, [arguments] { return run_export(*arguments); }};
}

}  // namespace floc
