#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "command.h"
#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/packing/equilibrium.h"
#include "floc/picture/sheet.h"
#include "floc/structure/coordination.h"
#include "output.h"
#include "run_states.h"
#include "state_picture.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

constexpr double kPointsPerCentimetre = 72.0 / 2.54;
constexpr int kPictures = 4;  ///< of a directory without --steps

struct DrawArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::string forces = "equilibrium";
  std::string step = "isotropic";
  std::string compare;
  std::vector<int> steps;
  std::string as;
  double width = 17.0;  ///< (cm)
  SheetOptions sheet;
  bool image = false;
  bool vectors = false;
  std::string format;
};

Shown shown_by(const DrawArguments& arguments) {
  if (arguments.forces == "particle-pressure") return Shown::particle_pressure;
  if (arguments.forces == "none") return Shown::grains;
  if (arguments.forces == "equilibrium") return Shown::equilibrium;
  return arguments.step == "isotropic" ? Shown::isotropic_step : Shown::deviatoric_step;
}

PictureFormat format_named(const std::string& keyword) {
  return keyword == "pdf" ? PictureFormat::pdf : keyword == "png" ? PictureFormat::png : PictureFormat::svg;
}

/// Where pictures go: one file, stdout, or a file a state in a directory.
struct Target {
  bool directory = false;
  bool standard_output = false;
  std::string suffix;  ///< ".svg", ...

  std::string of(const DrawArguments& arguments, const std::string& state) const {
    if (!directory) return arguments.output;
    const std::string stem = state == "-" ? "stdin" : fs::path(state).stem().string();
    return (fs::path(arguments.output) / (stem + suffix)).string();
  }
};

Target target_of(const DrawArguments& arguments) {
  Target target;
  target.standard_output = arguments.output == "-";
  target.directory = arguments.output.ends_with('/') || fs::is_directory(arguments.output);
  const std::string extension = fs::path(arguments.output).extension().string();
  target.suffix = "." + (arguments.as.empty() ? "svg" : arguments.as);
  if (target.standard_output || target.directory) return target;
  if (arguments.as.empty() && extension != ".svg" && extension != ".pdf" && extension != ".png")
    throw InputError("-o " + arguments.output,
                     "expected a name that ends in .svg, .pdf or .png, a directory, or -");
  if (arguments.as.empty()) target.suffix = extension;
  return target;
}

/// A state read and its picture.
struct Drawn {
  std::string file;
  PackingPicture picture;
  std::vector<TableValue> cells;  ///< P_star, phi, z
};

/// @param other  the state to compare with, if there is one
Drawn drawn_from(const std::string& file, const AnyState& any, const DrawArguments& arguments,
                 const std::optional<AnyState>& other) {
  const State<2>& state = disks_of(file, any);
  return {file,
          other ? picture_of_changes(file, state, arguments.compare, disks_of(arguments.compare, *other))
                : picture_of(file, state, shown_by(arguments)),
          {reduced_pressure(state.packing, state.target_stress.mean()), solid_fraction(state.packing),
           coordination(state.packing, 0.0).z}};
}

std::int64_t count_kind(const PackingPicture& picture, LineKind kind) {
  return std::count_if(picture.lines.begin(), picture.lines.end(),
                       [kind](const ContactLine& line) { return line.kind == kind; });
}

void add_row(const Drawn& drawn, const std::string& name, Table& table) {
  std::vector<TableValue> row = {drawn.file, name};
  for (const TableValue& cell : drawn.cells) row.push_back(cell);
  row.emplace_back(static_cast<std::int64_t>(drawn.picture.position.size()));
  for (const LineKind kind : {LineKind::compression, LineKind::tension, LineKind::zero, LineKind::distant,
                              LineKind::background, LineKind::lost, LineKind::gained})
    row.emplace_back(count_kind(drawn.picture, kind));
  table.rows.push_back(std::move(row));
}

/// One scale of colours for all pictures of a strip.
void share_shades(std::vector<PackingPicture>& strip) {
  double largest = 0.0;
  for (const PackingPicture& picture : strip) largest = std::max(largest, picture.shade.largest);
  for (PackingPicture& picture : strip) picture.shade.largest = largest;
}

void write_picture(const Target& target, const std::string& path, const std::string& bytes) {
  if (!target.standard_output) return write_bytes_atomically(path, bytes);
  std::cout << bytes << std::flush;
  if (!std::cout) throw IoError("standard output", "cannot be written");
}

int draw(DrawArguments arguments) {
  const Target target = target_of(arguments);
  arguments.sheet.format = format_named(target.suffix.substr(1));
  arguments.sheet.width = arguments.width * kPointsPerCentimetre;
  if (arguments.image || arguments.vectors) arguments.sheet.as_image = arguments.image;
  if (const auto faults = arguments.sheet.validate(); !faults.empty())
    throw InputError("floc draw", fmt::format("{}", fmt::join(faults, "; ")));
  Table table{{"file", "picture", "P_star", "phi", "z", "n_grains", "n_compression", "n_tension", "n_zero",
               "n_distant", "n_other", "n_lost", "n_gained"},
              {}};
  if (target.directory) fs::create_directories(arguments.output);
  std::optional<AnyState> other;
  if (!arguments.compare.empty()) other = read_state(arguments.compare);
  std::vector<PackingPicture> strip;
  const int code =
      for_each_state(drawn_states(arguments.inputs, arguments.steps, kPictures),
                     [&](const std::string& file, const AnyState& state) {
                       Drawn drawn = drawn_from(file, state, arguments, other);
                       const std::string path = target.of(arguments, file);
                       add_row(drawn, path, table);
                       if (target.directory)
                         write_picture(target, path, draw_sheet({std::move(drawn.picture)}, arguments.sheet));
                       else
                         strip.push_back(std::move(drawn.picture));
                       return int{kDone};
                     });
  share_shades(strip);
  if (!strip.empty()) write_picture(target, arguments.output, draw_sheet(strip, arguments.sheet));
  if (!target.standard_output && !table.rows.empty()) print_table(table, arguments.format);
  return code;
}

}  // namespace

Command add_draw(CommandLine program) {
  CommandLine app = program.add_subcommand("draw", "pictures of packings and their forces: svg, pdf or png");
  const auto arguments = std::make_shared<DrawArguments>();
  app.add_option(
         "STATE", arguments->inputs,
         "state files, - for one on stdin, or directories of floc run (see --steps); several make a strip")
      .required();
  app.add_option("-o,--output", arguments->output,
                 "F.svg, F.pdf or F.png; a directory: a picture each; -: stdout, and no table")
      .required();
  const Option forces =
      app.add_option("--forces", arguments->forces,
                     "equilibrium; increment: what a small step of stress adds, the contacts that hold 95 % "
                     "of its energy "
                     "in colour; particle-pressure: colour of the grains; or none [equilibrium]")
          .one_of({"equilibrium", "increment", "particle-pressure", "none"});
  app.add_option("--step", arguments->step, "of --forces increment: isotropic or deviatoric [isotropic]")
      .one_of({"isotropic", "deviatoric"});
  app.add_option(
         "--compare", arguments->compare,
         "STATE2: contacts lost and gained on the way to it, and where grains went, affine part taken off")
      .excludes(forces);
  app.add_option("--steps", arguments->steps, "K,...: states of a directory [four, from the first to the last]")
      .delimiter(',')
      .non_negative();
  app.add_option("--as", arguments->as, "svg, pdf or png, whatever the name [its ending; otherwise svg]")
      .one_of({"svg", "pdf", "png"});
  app.add_option("--width", arguments->width, "of the page in cm [17]");
  app.add_option("--columns", arguments->sheet.columns, "of a strip [4]");
  app.add_option("--line-width", arguments->sheet.line_width,
                 "of the r.m.s. force, in mean diameters; widths are proportional to |F| [0.15]");
  app.add_flag("--same-scale", arguments->sheet.same_force_scale,
               "a force has one width in all pictures of a strip [each has its own scale, and says it]");
  app.add_flag("--bare", arguments->sheet.bare, "no captions, no legend");
  app.add_option(
      "--resolution", arguments->sheet.resolution,
      "pixels per inch of a png or an image [6 pixels a grain, 200 at least, 3000 pixels a side at most]");
  const Option image =
      app.add_flag("--image", arguments->image,
                   "svg and pdf: grains and lines as an image [where there are more than 15000]");
  app.add_flag("--vectors", arguments->vectors, "svg and pdf: grains and lines as vectors, however many")
      .excludes(image);
  add_format_option(app, arguments->format);
  return {app, [arguments] { return draw(*arguments); }};
}

}  // namespace floc
