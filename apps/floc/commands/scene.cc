#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "floc/assembly/size_classes.h"
#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/planning/duration.h"
#include "floc/scene/cost_model.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_warnings.h"
#include "floc/scene/starting_scene.h"
#include "floc/tables/size_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/prices_option.h"
#include "process/printing.h"

namespace floc {
namespace {

struct SceneArguments {
  std::string path;
  std::vector<std::string> overrides;
  std::string prices;
  /// Name of the csv file that compares the sizes of randomly drawn grains with the size distribution of the scene; if
  /// empty, no file is written.
  std::string sizes;
  Printing printing;
  std::string name;
};

/// Prints the expected processor time and memory of a run if a table of prices gives them.
void tell_price(const Scene& scene, const RunCost& cost) {
  if (cost.is_priced())
    spdlog::info("by the prices of the kind {}, a run takes {} of processor time and {:.0f} MB of memory",
                 scene_kind(scene), duration_in_words(cost.core_seconds), *cost.memory_mb);
}

int check_scene(const SceneArguments& arguments) {
  const Scene scene = read_scene(arguments.path, arguments.overrides, arguments.prices);
  Table table{{"group", "value", "meaning"}, {}};
  const RunCost cost = cost_of_run(scene, arguments.prices);
  for (const DerivedGroup& g : derived_groups(scene, cost)) table.rows.push_back({g.name, g.value, g.meaning});
  print_table(table, arguments.printing);
  if (!arguments.sizes.empty())
    write_csv(arguments.sizes, size_table(size_classes(scene.grains, scene.dimension)));
  if (!scene.start.empty()) spdlog::info("starting state: {}", scene.start);
  if (!scene.accuracy.empty())
    spdlog::info("numerical settings chosen for the accuracy that the scene requires: {}", scene.accuracy);
  tell_price(scene, cost);
  const std::vector<std::string> warnings = scene_warnings(scene);
  for (const std::string& warning : warnings) spdlog::warn("{}: warning: {}", arguments.path, warning);
  spdlog::info("{}: the scene has no faults{}", arguments.path,
               warnings.empty()       ? ""
               : warnings.size() == 1 ? ", 1 warning"
                                      : fmt::format(", {} warnings", warnings.size()));
  return kDone;
}

/// Writes a template of a scene to the file NAME.toml, or to stdout if the name is "-".
/// @throws InputError if the file exists already
int start_scene(const std::string& name) {
  if (name == "-") {
    write_bytes_atomically(name, starting_scene("powder"));
    return kDone;
  }
  std::filesystem::path path(name);
  if (path.extension() != ".toml") path += ".toml";
  const std::string text = starting_scene(path.stem().string());
  std::FILE* file = std::fopen(path.c_str(), "wx");
  if (!file && errno == EEXIST)
    throw InputError(path.string(),
                     "this file exists already and is not replaced: give another name for the new scene");
  if (!file) throw IoError(path.string(), std::strerror(errno));
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written)
    throw IoError(path.string(), "the file cannot be written completely; the disk may be full");
  spdlog::info(
      "wrote {0}, a copy of the scene of floc demo, a cohesive powder "
      "(data/scenes contains scenes of other materials); you may run next: floc scene "
      "check {0}, floc "
      "run {0} -o {1}",
      path.string(), path.stem().string());
  return kDone;
}

}  // namespace

Command add_scene(CommandLine program) {
  auto arguments = std::make_shared<SceneArguments>();
  CommandLine app = program.add_subcommand("scene", "Check a scene file, or start a new one");
  app.require_one_subcommand();
  CommandLine check = app.add_subcommand(
      "check",
      "check a scene file: list all its faults, or print its dimensionless groups and its expected cost");
  check.add_option("SCENE", arguments->path, "scene file (TOML)").required();
  check
      .add_option("--set", arguments->overrides,
                  "KEY=VALUE: set one key of the scene to another value, e.g. contact.rolling.coefficient=0.5")
      .one_argument_each();
  add_prices_option(check, arguments->prices);
  check.add_option("--sizes", arguments->sizes,
                   "csv file to write, with one row per interval of diameters (between two sieves of a "
                   "sieve curve, otherwise a quarter of the range): the number of grains that a run "
                   "draws, their share of the volume, and the share that the distribution prescribes");
  add_printing_options(check, arguments->printing);
  CommandLine start = app.add_subcommand(
      "new", "write a commented scene of a cohesive powder, as a template for your own, to the file NAME.toml");
  start
      .add_option(
          "NAME", arguments->name,
          "name of the scene file, without .toml (the content does not depend on it); - writes to stdout")
      .required();
  // Because of require_one_subcommand(), a command line without the subcommand `check` has the subcommand `new`.
  return {app, [arguments, check] {
            return check.parsed() ? check_scene(*arguments) : start_scene(arguments->name);
          }};
}

}  // namespace floc
