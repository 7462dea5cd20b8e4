#include "floc/scene/read_accuracy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "floc/prices/accuracy.h"
#include "floc/scene/check_resolution.h"
#include "floc/scene/scene_prices.h"

namespace floc {
namespace {

constexpr NumberRule kRelativeError{positive, "a positive number (relative error)"};

/// Records a fault for each key that gives a numerical setting which the table [accuracy] chooses. A scene may give
/// either [accuracy] or these keys.
void refuse_settings(TableReader& root) {
  TableReader equilibrium = root.table("equilibrium", "", TableReader::Need::optional);
  TableReader run = root.table("run", "", TableReader::Need::optional);
  const auto refuse = [](TableReader& t, const char* key) {
    t.refuse(key,
             fmt::format("{} is chosen by [accuracy]: expected either this key or [accuracy]", t.path_of(key)));
  };
  for (const char* key : {"force", "moment", "stress", "energy", "patience", "masses"})
    refuse(equilibrium, key);
  const auto finish = equilibrium.text("finish", "a string", TableReader::Need::optional);
  if (finish && *finish != "auto") refuse(equilibrium, "finish");
  refuse(run, "time_step");
}

/// Writes the chosen numerical settings into the TOML tables of the scene. The text of the scene then contains the
/// settings of the run, which stay the same even if a later version of floc has another table of measured errors.
void write_choice(const AccuracyChoice& choice, toml::table& root) {
  const auto table = [&](const char* name) -> toml::table& {
    return *root.insert(name, toml::table{}).first->second.as_table();
  };
  const NumericalSettings& s = choice.settings;
  table("accuracy").insert_or_assign("chosen", fmt::format("{}: {}", choice.name, choice.reason));
  toml::table& equilibrium = table("equilibrium");
  for (const char* key : {"force", "moment", "stress"}) equilibrium.insert_or_assign(key, s.tolerance);
  equilibrium.insert_or_assign("energy", s.energy());
  equilibrium.insert_or_assign("patience", s.patience);
  equilibrium.insert_or_assign("finish", finish_name(s.finish));
  table("run").insert_or_assign("time_step", s.time_step);
}

}  // namespace

bool read_accuracy(TableReader& root, SceneSource& source, const std::string& prices, Scene& scene) {
  TableReader t = root.table("accuracy", "a table [accuracy]", TableReader::Need::optional);
  // For contact dynamics, check_rigid() records the fault.
  if (!t || scene.has_contact_dynamics()) return false;
  WantedAccuracy wanted;
  for (const std::string& key : accuracy_keys())
    if (const auto error = t.number(key, kRelativeError, TableReader::Need::optional))
      wanted.emplace_back(key, *error);
  const auto chosen = t.text("chosen", "a text that floc writes", TableReader::Need::optional);
  t.refuse_other_keys();
  if (chosen) {
    scene.accuracy = *chosen;
    return false;
  }
  refuse_settings(root);
  // If `wanted` is empty although the table has keys, the values of these keys are invalid, and faults have been
  // recorded for them.
  const bool asks = std::ranges::any_of(accuracy_keys(), [&t](const std::string& key) { return t.has(key); });
  if (wanted.empty() && asks) return false;
  if (wanted.empty()) {
    t.fault("", fmt::format("[accuracy] requests no error: expected at least one of the keys {}",
                            fmt::join(accuracy_keys(), ", ")));
    return false;
  }
  // The kind of a scene, which determines the table of prices, is known only if the scene has no faults.
  if (source.n_faults() > 0) return false;
  const ScenePrices found = prices_of(scene, prices);
  if (!found.table) {
    t.fault("", fmt::format("[accuracy]: {}. Remove [accuracy] and give the numerical settings themselves "
                            "([equilibrium], run.time_step)",
                            found.problem));
    return false;
  }
  const AccuracyChoice choice =
      choose_accuracy(*found.table, wanted, cells_of(scene), stress_tolerance_limit(scene));
  if (!choice.found()) {
    const auto asked = std::find_if(wanted.begin(), wanted.end(),
                                    [&](const auto& w) { return w.first == choice.refused_key; });
    t.fault(asked->first,
            fmt::format("accuracy.{} = {:g}: {}", asked->first, asked->second, choice.failure_reason));
    return false;
  }
  scene.accuracy = fmt::format("{}: {}", choice.name, choice.reason);
  choice.settings.apply(scene.relaxation);
  write_choice(choice, source.root());
  return true;
}

}  // namespace floc
