#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <tuple>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/range.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/require_elastic.h"
#include "floc/picture/cross_section.h"
#include "floc/picture/drawn_scale.h"
#include "floc/picture/sheet.h"
#include "floc/structure/coordination.h"
#include "plots/state_picture.h"
#include "process/command.h"
#include "process/cut_option.h"
#include "process/output.h"
#include "process/printing.h"
#include "process/run_states.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

constexpr double kPointsPerCentimetre = 72.0 / 2.54;
/// Range of the width of a page (cm), within the range of SheetOptions, which is 50 to 5000 points.
constexpr NumberRange kWidthRange{.least = 1.8, .most = 176.0};
constexpr int kPictures = 4;  ///< number of states of a directory that are drawn if --steps is not given

struct DrawArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::string forces;  ///< empty for the default: equilibrium, or none in a section
  std::string step = "isotropic";
  std::string compare;
  std::vector<int> steps;
  std::string as;
  double width = 17.0;  ///< width of the page (cm)
  SheetOptions sheet;
  bool image = false;
  bool vectors = false;
  std::string view, slab, cut;
  std::optional<Slab> layer;            ///< layer of the cell whose grains are drawn, parsed from `slab`
  std::optional<CrossSection> section;  ///< plane whose section is drawn, parsed from `cut`
  Printing printing;
};

Shown shown_by(const DrawArguments& arguments) {
  if (arguments.forces == "particle-pressure") return Shown::particle_pressure;
  if (arguments.forces == "phases") return Shown::phases;
  if (arguments.forces == "kinds") return Shown::kinds;
  if (arguments.forces == "none" || (arguments.forces.empty() && arguments.section)) return Shown::grains;
  if (arguments.forces == "equilibrium" || arguments.forces.empty()) return Shown::equilibrium;
  return arguments.step == "isotropic" ? Shown::isotropic_step : Shown::deviatoric_step;
}

PictureFormat format_named(const std::string& keyword) {
  return keyword == "pdf" ? PictureFormat::pdf : keyword == "png" ? PictureFormat::png : PictureFormat::svg;
}

/// Output for the pictures: one file, stdout, or a directory with one file per state.
struct Target {
  bool directory = false;
  bool standard_output = false;
  std::string suffix;  ///< file name extension, such as ".svg"

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
                     "the name of the picture does not say its format: expected a name that ends in "
                     ".svg, .pdf or .png, a directory, or - for stdout");
  if (arguments.as.empty()) target.suffix = extension;
  return target;
}

/// Parses the text "A,B,..." as `count` numbers. Returns std::nullopt if the text contains another number of items, or
/// an item that is not a number.
std::optional<std::vector<double>> numbers_of(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = parse_number<double>(std::string_view(text).substr(begin, end - begin));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

/// Parses the values of the options --view, --slab and --cut.
/// @throws InputError if a value is invalid
void read_sight(DrawArguments& arguments) {
  if (!arguments.view.empty()) {
    const auto angles = numbers_of(arguments.view, 2);
    if (!angles)
      throw InputError(
          "--view " + arguments.view,
          "this is not a direction of view: expected AZIMUTH,ELEVATION, two angles in degrees, such as -65,20");
    arguments.sheet.view.azimuth = (*angles)[0];
    arguments.sheet.view.elevation = (*angles)[1];
  }
  if (!arguments.cut.empty()) {
    arguments.section = parse_cut(arguments.cut);
    for (const char* forces : {"equilibrium", "increment", "kinds"})
      if (arguments.forces == forces)
        throw InputError(
            "--forces " + arguments.forces,
            "--cut shows sections of grains without contacts: expected none, particle-pressure or phases");
  }
  if (arguments.slab.empty()) return;
  const std::size_t axis = std::string("x,y,z,").find(arguments.slab.substr(0, 2));
  const auto ends = arguments.slab.size() < 2 || axis == std::string::npos
                        ? std::nullopt
                        : numbers_of(arguments.slab.substr(2), 2);
  if (!ends)
    throw InputError("--slab " + arguments.slab,
                     "this is not a slab: expected AXIS,FROM,TO with an axis x, y or z and two fractions of "
                     "the cell, such as z,0.4,0.6");
  arguments.layer = Slab{static_cast<int>(axis / 2), (*ends)[0], (*ends)[1]};
}

/// A picture of a state, and the values of this state in a row of the printed table.
template <int Dim>
struct Drawn {
  std::string file;
  PackingPicture<Dim> picture;
  std::vector<TableValue> cells;  ///< values of the columns P_star, phi and z
  double driven_stress;           ///< value of the column P_driven_star
};

void keep_slab(const std::string& file, const DrawArguments& arguments, PackingPicture<3>& picture) {
  picture = part_in_slab(picture, *arguments.layer);
  if (picture.position.empty())
    throw InputError(file, "this state has no grain whose centre lies in --slab " + arguments.slab +
                               ": choose a slab that contains at least one grain");
  picture.caption.push_back(fmt::format("{} from {} to {} of the cell", "xyz"[arguments.layer->axis],
                                        short_number(arguments.layer->from),
                                        short_number(arguments.layer->to)));
}

/// Replaces the picture of a state by the section that --cut names.
Drawn<2> section_of(Drawn<3> drawn, const DrawArguments& arguments) {
  PackingPicture<2> section = cross_section(drawn.picture, *arguments.section);
  if (section.position.empty())
    throw InputError(drawn.file,
                     "the plane of --cut " + arguments.cut +
                         " crosses no grain of this state: choose a plane that crosses at least one grain");
  section.caption.push_back(fmt::format("section at {} = {} of the cell", "xyz"[arguments.section->axis],
                                        short_number(arguments.section->at)));
  return {drawn.file, std::move(section), std::move(drawn.cells), drawn.driven_stress};
}

/// Makes the picture of a state.
/// @param other  second state, given by the option --compare; absent without this option. If present, the picture shows
/// the changes of contacts and grains from `state` to `other`
template <int Dim>
Drawn<Dim> drawn_from(const std::string& file, const State<Dim>& state, const DrawArguments& arguments,
                      const std::optional<AnyState>& other) {
  if (Dim == 2 &&
      (arguments.layer || arguments.section || !arguments.view.empty() || arguments.sheet.view.sphere_size))
    throw InputError(
        file, state.packing.grains.are_round()
                  ? "this is a state of disks, but --view, --slab, --cut and --sphere-size apply only to "
                    "states of spheres: leave them out"
                  : "this is a state in 2D, but --view, --slab, --cut and --sphere-size apply only to states "
                    "in 3D: leave them out");
  if (other && !std::holds_alternative<State<Dim>>(*other))
    throw InputError(
        arguments.compare,
        fmt::format("this is a state in {}D, but {} is in {}D: --compare needs two states of the same grains",
                    Dim == 2 ? 3 : 2, file, Dim));
  Drawn<Dim> drawn = {file,
                      other ? picture_of_changes(file, state, arguments.compare, std::get<State<Dim>>(*other))
                            : picture_of(file, state, shown_by(arguments)),
                      {reduced_pressure(state.packing, state.target_stress.mean()),
                       solid_fraction(state.packing), coordination(state.packing, 0.0).z},
                      reduced_pressure(state.packing, stress_on_driven_axis<Dim>(state, state.target_stress))};
  if constexpr (Dim == 3)
    if (arguments.layer) keep_slab(file, arguments, drawn.picture);
  return drawn;
}

template <int Dim>
std::int64_t count_kind(const PackingPicture<Dim>& picture, LineKind kind) {
  return std::count_if(picture.lines.begin(), picture.lines.end(),
                       [kind](const ContactLine<Dim>& line) { return line.kind == kind; });
}

template <int Dim>
void add_row(const Drawn<Dim>& drawn, const std::string& name, Table& table) {
  std::vector<TableValue> row = {drawn.file, name};
  for (const TableValue& cell : drawn.cells) row.push_back(cell);
  row.emplace_back(static_cast<std::int64_t>(drawn.picture.position.size()));
  for (const LineKind kind : {LineKind::compression, LineKind::tension, LineKind::zero, LineKind::distant,
                              LineKind::background, LineKind::lost, LineKind::gained})
    row.emplace_back(count_kind(drawn.picture, kind));
  row.emplace_back(drawn.driven_stress);
  table.rows.push_back(std::move(row));
}

/// Gives all pictures of a strip (pictures side by side) the same colour scale. The end of the scale is the largest
/// value in any of the pictures.
template <int Dim>
void share_shades(std::vector<PackingPicture<Dim>>& strip) {
  double largest = 0.0;
  for (const PackingPicture<Dim>& picture : strip) largest = std::max(largest, picture.shade.largest);
  for (PackingPicture<Dim>& picture : strip) picture.shade.largest = largest;
}

void write_picture(const Target& target, const std::string& path, const std::string& bytes) {
  write_output(target.standard_output ? "-" : path, bytes);
}

/// Draws several states, either each in its own picture or all side by side in one picture, a strip.
class Drawer {
 public:
  Drawer(const DrawArguments& arguments, const Target& target) : arguments_(arguments), target_(target) {
    if (!arguments.compare.empty()) other_ = read_state(arguments.compare);
  }

  template <int Dim>
  void add(const std::string& file, const State<Dim>& state) {
    Drawn<Dim> drawn = drawn_from(file, state, arguments_, other_);
    if constexpr (Dim == 3)
      if (arguments_.section) return place(section_of(std::move(drawn), arguments_));
    place(std::move(drawn));
  }

  /// Writes the strip if all states are in one picture. Then prints the table of the states, except if the picture was
  /// written to stdout.
  void finish() {
    write_strip<2>();
    write_strip<3>();
    if (!target_.standard_output && !table_.rows.empty()) print_table(table_, arguments_.printing);
  }

 private:
  /// Writes a picture to its own file, or adds it to the strip.
  template <int Dim>
  void place(Drawn<Dim> drawn) {
    auto& strip = std::get<std::vector<PackingPicture<Dim>>>(strips_);
    auto& others = std::get<std::vector<PackingPicture<5 - Dim>>>(strips_);
    if (!others.empty())
      throw InputError(
          drawn.file,
          fmt::format("this is a state in {}D, but the states before it are not: all states of a picture "
                      "must have the same dimension (-o DIR/ draws each state as a separate picture)",
                      Dim));
    const std::string path = target_.of(arguments_, drawn.file);
    add_row(drawn, path, table_);
    if (target_.directory)
      write_picture(target_, path, draw_sheet<Dim>({std::move(drawn.picture)}, arguments_.sheet));
    else
      strip.push_back(std::move(drawn.picture));
  }

  template <int Dim>
  void write_strip() {
    auto& strip = std::get<std::vector<PackingPicture<Dim>>>(strips_);
    if (strip.empty()) return;
    share_shades(strip);
    write_picture(target_, arguments_.output, draw_sheet(strip, arguments_.sheet));
  }

  const DrawArguments& arguments_;
  const Target& target_;
  std::optional<AnyState> other_;
  Table table_{{"file", "picture", "P_star", "phi", "z", "n_grains", "n_compression", "n_tension", "n_zero",
                "n_distant", "n_other", "n_lost", "n_gained", "P_driven_star"},
               {}};
  std::tuple<std::vector<PackingPicture<2>>, std::vector<PackingPicture<3>>> strips_;
};

int draw(DrawArguments arguments) {
  const Target target = target_of(arguments);
  arguments.sheet.format = format_named(target.suffix.substr(1));
  arguments.sheet.width = arguments.width * kPointsPerCentimetre;
  if (arguments.image || arguments.vectors) arguments.sheet.as_image = arguments.image;
  read_sight(arguments);
  if (!kWidthRange.holds(arguments.width))
    throw InputError(
        fmt::format("--width {}", arguments.width),
        fmt::format("expected a width of the page from {} to {} cm", kWidthRange.least, kWidthRange.most));
  auto faults = arguments.sheet.validate();
  if (arguments.layer)
    for (const std::string& fault : arguments.layer->validate()) faults.push_back(fault);
  if (!faults.empty()) throw InputError("floc draw", fmt::format("{}", fmt::join(faults, "; ")));
  if (target.directory) fs::create_directories(arguments.output);
  Drawer drawer(arguments, target);
  const int code = for_each_state(drawn_states(arguments.inputs, arguments.steps, kPictures),
                                  [&drawer](const std::string& file, const AnyState& any, const Remarks&) {
                                    std::visit([&](const auto& state) { drawer.add(file, state); }, any);
                                    return int{kDone};
                                  });
  drawer.finish();
  return code;
}

}  // namespace

Command add_draw(CommandLine program) {
  CommandLine app = program.add_subcommand("draw", "Draw packings and their contact forces as svg, pdf or png");
  const auto arguments = std::make_shared<DrawArguments>();
  app.add_option("STATE", arguments->inputs,
                 "state files (- for a state on stdin), or directories of floc run (see --steps); several "
                 "states are drawn side by side in one picture, a strip")
      .required();
  app.add_option("-o,--output", arguments->output,
                 "picture to write: F.svg, F.pdf or F.png; a directory for a separate picture of each state; - "
                 "writes the picture to stdout and prints no table")
      .required();
  const Option forces =
      app.add_option("--forces", arguments->forces,
                     "forces to draw. equilibrium: contact forces of the state; increment: changes of the "
                     "contact forces in a small stress increment, in colour for the contacts that store "
                     "95 % of the elastic energy of the increment; particle-pressure: grains "
                     "coloured by their pressure; phases: grains with positive and with negative "
                     "pressure, and the contacts between grains of the same sign; kinds: forces of grains "
                     "with corners, coloured by the kind of contact (vertex and face, edge and face, or "
                     "two faces); none: no forces [equilibrium; with --cut, none]")
          .one_of({"equilibrium", "increment", "particle-pressure", "phases", "kinds", "none"});
  app.add_option("--step", arguments->step,
                 "type of the stress increment for --forces increment: isotropic or deviatoric [isotropic]")
      .one_of({"isotropic", "deviatoric"});
  // The option --compare excludes --forces, because pictures of --compare show displacements of the grains instead of
  // forces.
  const Option compare =
      app.add_option("--compare", arguments->compare,
                     "STATE2: draw the contacts that are lost and gained between STATE and STATE2, and the "
                     "non-affine displacements of the grains")
          .excludes(forces);
  app.add_option("--steps", arguments->steps,
                 "K,...: numbers of the states of a directory to draw [four states, evenly spread from the "
                 "first to the last]")
      .delimiter(',')
      .non_negative();
  app.add_option("--as", arguments->as,
                 "format of the picture, regardless of the file name: svg, pdf or png [according to the "
                 "extension of the file name, svg without one]")
      .one_of({"svg", "pdf", "png"});
  app.add_option("--width", arguments->width, "width of the page (cm), from 1.8 to 176 [17]");
  app.add_option("--columns", arguments->sheet.columns, "number of pictures in each row of a strip [4]");
  app.add_option("--line-width", arguments->sheet.line_width,
                 "line width, in mean diameters, of a contact whose force is the r.m.s. force; line widths are "
                 "proportional to the force [0.15]");
  app.add_flag("--same-scale", arguments->sheet.same_force_scale,
               "use a common scale of line widths for all pictures of a strip [each picture has its own scale, "
               "given in its legend]");
  app.add_flag("--bare", arguments->sheet.bare, "draw no captions and no legend");
  app.add_option(
      "--resolution", arguments->sheet.resolution,
      "resolution of a png picture or of an image embedded in svg or pdf (pixels per inch) [6 pixels per mean "
      "diameter, but at least 200 pixels per inch and at most 3000 pixels per side]");
  // If neither --image nor --vectors is given, grains and lines are drawn as an image only if there are many of them.
  const Option image = app.add_flag(
      "--image", arguments->image,
      "in svg and pdf, embed grains and lines as an image [if there are more than 15000 of them, in 3D 6000]");
  app.add_flag("--vectors", arguments->vectors,
               "in svg and pdf, draw grains and lines as vectors, even if there are many of them")
      .excludes(image);
  const Option view = app.add_option(
      "--view", arguments->view,
      "AZIMUTH,ELEVATION: direction from which grains in 3D are viewed (degrees); azimuth 0 is the x "
      "axis, azimuth 90 the y axis [-65,20]");
  const Option slab = app.add_option(
      "--slab", arguments->slab,
      "AXIS,FROM,TO: draw only the grains whose centres lie between two fractions of the cell, for "
      "example z,0.4,0.6");
  const Option size = app.add_option(
      "--sphere-size", arguments->sheet.view.sphere_size,
      "ratio of the drawn radius of spheres to their true radius, from 0 to 1 [1; 0.25 if forces or "
      "changes are drawn]");
  app.add_option(
         "--cut", arguments->cut,
         "AXIS,FRACTION: draw the section of a packing in 3D by a plane across AXIS, at this fraction of the "
         "cell, for example y,0.5; contacts are left out")
      .excludes(slab)
      .excludes(view)
      .excludes(size)
      .excludes(compare);
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return draw(*arguments); }};
}

}  // namespace floc
