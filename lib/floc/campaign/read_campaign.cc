#include "floc/campaign/read_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>

#include "floc/base/error.h"
#include "floc/base/read_text.h"
#include "floc/base/seed_range.h"
#include "floc/campaign/campaign_cases.h"
#include "floc/scene/table_reader.h"

namespace floc {
namespace {

namespace fs = std::filesystem;
using Need = TableReader::Need;

/// Largest numbers of seeds and of runs of a campaign. A campaign file with more seeds or runs is refused, because it
/// is probably a mistake.
constexpr std::uint64_t kMaxSeeds = 10'000;
constexpr std::size_t kMaxRuns = 100'000;

constexpr NumberRule kAnyNumber{[](double) { return true; }, "a finite number"};
constexpr NumberRule kNotNegative{[](double x) { return x >= 0.0; }, "a number >= 0"};
constexpr NumberRule kPressures{[](double x) { return x >= 0.0; },
                                "a reduced pressure >= 0, or a list of reduced pressures"};
constexpr NumberRule kSteps{[](double x) { return x >= 0.0 && x == std::floor(x) && x < 1e6; },
                            "the number of a state, counted from 0, or a list of numbers of states"};
constexpr const char* kStates =
    "\"all\", \"last\", {step = [0, 5]}, {branch = \"load\", P_star = [0.1, 1.0]} or {branch = \"load\", "
    "P_driven_star = [0.1, 1.0]}";

/// A table of the campaign file, together with the reader of the keys of this table.
struct Part {
  TableReader reader;
  const toml::table& table;
  SceneSource& source;

  std::string place() const { return source.place_of(reader.path(), &table); }
  const toml::node* get(const std::string& key) const { return table.get(key); }
};

bool is_scalar(const toml::node& node) {
  return node.is_string() || node.is_boolean() || node.is_integer() ||
         (node.is_floating_point() && std::isfinite(node.as_floating_point()->get()));
}

bool is_list(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && !array->empty() && std::all_of(array->begin(), array->end(), is_scalar);
}

/// A value in a table of the campaign file, or in a table inside that table. The key of the value is relative to the
/// outer table, with dots between the names: "friction.coefficient".
struct Leaf {
  std::string key;
  const toml::node* node;
};

/// Returns the values in a table and in the tables inside it, in the order of the file.
std::vector<Leaf> leaves_of(const toml::table& table, const std::string& path = "") {
  std::vector<Leaf> leaves;
  for (const auto& [name, node] : table) {
    const std::string key = path.empty() ? std::string(name.str()) : path + "." + std::string(name.str());
    if (const toml::table* below = node.as_table()) {
      for (Leaf& leaf : leaves_of(*below, key)) leaves.push_back(std::move(leaf));
    } else {
      leaves.push_back({key, &node});
    }
  }
  std::stable_sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
    const auto place = [](const Leaf& l) {
      return std::tuple(l.node->source().begin.line, l.node->source().begin.column);
    };
    return place(a) < place(b);
  });
  return leaves;
}

void refuse(SceneSource& source, const std::string& key, const toml::node& node, const std::string& expected) {
  source.fault(key, &node, fmt::format("{} = {}: expected {}", key, as_written(node), expected));
}

/// Reads the changes of a scene from a table whose keys are keys of the scene.
std::vector<SceneChange> read_changes(Part& part, const std::string& key, Need need) {
  std::vector<SceneChange> changes;
  constexpr const char* kExpected =
      "a table of keys of the scene with their values, such as {contact.friction.coefficient = 0.3}";
  if (!part.reader.table(key, kExpected, need)) return changes;
  for (const Leaf& leaf : leaves_of(*part.get(key)->as_table())) {
    if (is_scalar(*leaf.node) || is_list(*leaf.node))
      changes.push_back({leaf.key, as_written(*leaf.node),
                         part.source.place_of(part.reader.path_of(key + "." + leaf.key), leaf.node)});
    else
      refuse(part.source, part.reader.path_of(key + "." + leaf.key), *leaf.node,
             "a number, a string, true, false, or a list of such values");
  }
  return changes;
}

std::vector<GridAxis> read_grid(TableReader& root, SceneSource& source) {
  std::vector<GridAxis> axes;
  if (!root.table("grid", "a table of keys of the scene, each with a list of values", Need::optional))
    return axes;
  for (const Leaf& leaf : leaves_of(*source.root().get("grid")->as_table())) {
    if (!is_list(*leaf.node)) {
      refuse(source, "grid." + leaf.key, *leaf.node, "a list of one or more values of this key of the scene");
      continue;
    }
    GridAxis& axis = axes.emplace_back(GridAxis{leaf.key, {}, source.place_of("grid." + leaf.key, leaf.node)});
    for (const toml::node& value : *leaf.node->as_array()) axis.values.push_back(as_written(value));
    for (std::size_t k = 1; k < axis.values.size(); ++k)
      if (std::count(axis.values.begin(), axis.values.begin() + static_cast<std::ptrdiff_t>(k),
                     axis.values[k]) > 0)
        source.fault("grid." + leaf.key, leaf.node,
                     fmt::format("grid.{} has {} twice: expected each value once", leaf.key, axis.values[k]));
  }
  return axes;
}

std::vector<std::uint64_t> read_seeds(Part& part) {
  const toml::node* node = part.get("seeds");
  if (node == nullptr || node->is_string()) {
    const auto text = part.reader.text("seeds", "\"1..4\" or a list such as [1, 2, 5]");
    if (!text) return {};
    const auto range = seed_range_of(*text);
    std::vector<std::uint64_t> seeds;
    if (range && range->last - range->first < kMaxSeeds)
      for (std::uint64_t n = 0; n <= range->last - range->first; ++n) seeds.push_back(range->first + n);
    else
      refuse(part.source, part.reader.path_of("seeds"), *node,
             fmt::format("A..B with two whole numbers, A not larger than B, and at most {} seeds", kMaxSeeds));
    return seeds;
  }
  constexpr NumberRule kSeed{[](double x) { return x >= 0.0 && x == std::floor(x) && x < 9e15; },
                             "\"1..4\" or a list of whole numbers >= 0, such as [1, 2, 5]"};
  std::vector<std::uint64_t> seeds;
  std::set<double> seen;
  for (const double x : part.reader.numbers("seeds", kSeed)) {
    if (!seen.insert(x).second)
      part.reader.fault(
          "seeds", fmt::format("{} has {} twice: expected each seed once", part.reader.path_of("seeds"), x));
    seeds.push_back(static_cast<std::uint64_t>(x));
  }
  return seeds;
}

/// Reads the value of a key that is a number or a list of numbers.
std::vector<double> one_or_more(TableReader& reader, const toml::table& table, const std::string& key,
                                NumberRule rule) {
  const toml::node* node = table.get(key);
  if (node == nullptr || node->is_array()) return reader.numbers(key, rule);
  const auto value = reader.number(key, rule);
  return value ? std::vector<double>{*value} : std::vector<double>{};
}

/// Reads a choice of states.
/// @param otherwise  kind of the choice that is returned if the key is missing
StateChoice read_states(Part& part, const std::string& key, StateChoice::Kind otherwise) {
  StateChoice choice;
  choice.kind = otherwise;
  choice.place = part.place();
  const toml::node* node = part.get(key);
  if (node == nullptr) return choice;
  choice.place = part.source.place_of(part.reader.path_of(key), node);
  const std::string word = node->is_string() ? node->as_string()->get() : "";
  if (word == "all" || word == "last") {
    (void)part.reader.text(key, kStates);
    choice.kind = word == "all" ? StateChoice::all : StateChoice::last;
    return choice;
  }
  TableReader states = part.reader.table(key, kStates, Need::optional);
  if (!states) return choice;
  const toml::table& table = *node->as_table();
  // A table selects states by one of three keys: `step` (number of the state), `P_star` (pressure on all axes) or
  // `P_driven_star` (pressure on the driven axis). It is an error if a table has several of these keys, or none.
  if (table.contains("step") + table.contains("P_star") + table.contains("P_driven_star") != 1) {
    part.reader.fault(key, fmt::format("{}: expected {}", part.reader.path_of(key), kStates));
    return choice;
  }
  choice.kind = table.contains("step") ? StateChoice::steps : StateChoice::pressures;
  for (const double step : one_or_more(states, table, "step", kSteps))
    choice.numbers.push_back(static_cast<int>(step));
  choice.is_driven = table.contains("P_driven_star");
  choice.P_star = one_or_more(states, table, choice.is_driven ? "P_driven_star" : "P_star", kPressures);
  if (choice.kind == StateChoice::pressures)
    choice.branch = states.text("branch", "the name of a branch of the load path", Need::optional).value_or("");
  states.refuse_other_keys();
  return choice;
}

Collection read_collection(Part& part) {
  Collection collection;
  collection.place = part.place();
  const std::vector<std::string> tables = {"path", "moduli", "network", "structure", "compare"};
  if (const auto which = part.reader.choice("table", tables)) collection.table = tables[*which];
  collection.columns = part.reader.texts("columns", "a list of columns of the table, such as [\"phi\", \"z\"]");
  if (!part.reader.has("columns"))
    part.reader.fault("columns", fmt::format("{} is missing: expected a list of columns of the table",
                                             part.reader.path_of("columns")));
  if (collection.table == "path")
    part.reader.refuse("options",
                       part.reader.path_of("options") +
                           " is not allowed with table = \"path\": floc run writes path.csv without options");
  else
    collection.options = part.reader.texts("options", "a list of options and their values, each a string");
  // The table "compare" needs the key `before`, which selects one state. By default, this state is compared with the
  // last state of the run.
  const bool compares = collection.table == "compare";
  collection.states = read_states(part, "states", compares ? StateChoice::last : StateChoice::all);
  if (compares) {
    collection.before = read_states(part, "before", StateChoice::all);
    if (!part.reader.has("before") || collection.before.kind == StateChoice::all)
      part.reader.fault("before",
                        fmt::format("{}: expected the one state to compare with, such as {{step = 1}}",
                                    part.reader.path_of("before")));
  } else {
    part.reader.refuse("before", part.reader.path_of("before") + " is only allowed with table = \"compare\"");
  }
  return collection;
}

CampaignFit read_fit(Part& part) {
  CampaignFit fit;
  fit.place = part.place();
  const std::vector<std::string> laws = {"consolidation", "elastic", "preconsolidation", "strength"};
  if (const auto which = part.reader.choice("law", laws)) fit.law = laws[*which];
  fit.options = part.reader.texts("options", "a list of options and their values, each a string");
  return fit;
}

Reference read_reference(Part& part) {
  Reference reference;
  reference.place = part.place();
  TableReader& t = part.reader;
  reference.quantity = t.text("of", "a column that is collected, or a parameter of a fit").value_or("");
  reference.fit = t.text("fit", "the law of a [[fit]]", Need::optional).value_or("");
  reference.when = read_changes(part, "when", Need::optional);
  reference.state = read_states(part, "state", StateChoice::all);
  if (reference.fit.empty() && !t.has("state"))
    t.fault("state", t.path_of("state") +
                         " is missing: expected one state, such as \"last\" or {branch = \"load\", P_star = "
                         "0.1}, or instead the key fit with the law of a [[fit]]");
  if (!reference.fit.empty())
    t.refuse("state", t.path_of("state") + " is only allowed for a column, not for a parameter of a fit");
  reference.value = t.number("value", kAnyNumber).value_or(0.0);
  reference.deviation = t.number("error", kNotNegative, Need::optional).value_or(0.0);
  constexpr IntegerRule kSamples{
      1, 1'000'000,
      "a whole number >= 1: the number of reference samples (the key error is their standard deviation)"};
  reference.n_samples = static_cast<int>(t.integer("samples", kSamples, Need::optional).value_or(1));
  reference.source = t.text("source", "the source of the value, such as a publication").value_or("");
  return reference;
}

/// Reads the table [plan], which floc plan writes.
std::optional<PlanPromise> read_promise(TableReader& root) {
  TableReader t = root.table("plan", "a table [plan], which floc plan writes", Need::optional);
  if (!t) return std::nullopt;
  constexpr NumberRule kSeconds{positive, "a positive number (processor time in s)"};
  PlanPromise promise;
  promise.settings = t.text("settings", "the name of numerical settings").value_or("");
  promise.prices = t.text("prices", "the table of prices of the plan").value_or("");
  promise.core_seconds = t.number("core_seconds", kSeconds).value_or(0.0);
  promise.errors = t.flat_numbers("errors");
  for (const auto& [name, error] : promise.errors)
    if (!(error > 0.0))
      t.fault("errors", fmt::format("{}.{} = {}: expected a positive number (relative error)",
                                    t.path_of("errors"), name, error));
  t.refuse_other_keys();
  return promise;
}

/// Reads an array of tables in the campaign file, such as [[case]]. The function `read` reads one table of the array.
/// Messages count the tables from 1: case.2 is the second [[case]].
template <class Read>
auto read_all(TableReader& root, SceneSource& source, const std::string& key, const char* expectation,
              Read read) {
  std::vector<decltype(read(std::declval<Part&>()))> all;
  const std::size_t n = root.tables(key, expectation).size();
  for (std::size_t k = 0; k < n; ++k) {
    const toml::table& table = *source.root().get(key)->as_array()->get(k)->as_table();
    Part part{TableReader(source, &table, fmt::format("{}.{}", key, k + 1)), table, source};
    all.push_back(read(part));
    part.reader.refuse_other_keys();
  }
  return all;
}

/// Records an error if a reference names a fit, a column or a key of the scene that the campaign does not have.
void check_references(const Campaign& campaign, SceneSource& source) {
  for (const Reference& r : campaign.references) {
    const bool is_fitted = std::any_of(campaign.fits.begin(), campaign.fits.end(),
                                       [&](const CampaignFit& fit) { return fit.law == r.fit; });
    const bool is_collected = std::any_of(
        campaign.collections.begin(), campaign.collections.end(),
        [&](const Collection& c) { return std::count(c.columns.begin(), c.columns.end(), r.quantity) > 0; });
    if (!r.fit.empty() && !is_fitted)
      source.fault_at(r.place,
                      fmt::format("fit = \"{}\": expected the law of a [[fit]] of this campaign", r.fit));
    if (r.fit.empty() && !r.quantity.empty() && !is_collected)
      source.fault_at(r.place,
                      fmt::format("of = \"{}\": expected a column that a [[collect]] names", r.quantity));
    for (const SceneChange& key : r.when)
      if (std::count(campaign.keys.begin(), campaign.keys.end(), key.key) == 0)
        source.fault_at(r.place,
                        fmt::format("when.{}: expected a key that [grid] or a [[case]] sets", key.key));
  }
}

/// Records an error for each column that is collected from two tables, or twice from one table with different options.
void check_collections(const Campaign& campaign, SceneSource& source) {
  for (std::size_t k = 0; k < campaign.collections.size(); ++k)
    for (std::size_t before = 0; before < k; ++before) {
      const Collection &one = campaign.collections[before], &other = campaign.collections[k];
      if (one.table == other.table && one.options == other.options && one.table != "compare") continue;
      for (const std::string& column : other.columns)
        if (std::count(one.columns.begin(), one.columns.end(), column) > 0)
          source.fault_at(other.place,
                          fmt::format("columns has {}, which is already collected from {} ({}): expected each "
                                      "column from one table, and always with the same options",
                                      column, one.table, one.place));
    }
}

}  // namespace

Campaign read_campaign(const std::string& path, const std::string& scene) {
  if (fs::is_directory(path)) throw InputError(path, "this is a directory: expected a campaign file (TOML)");
  SceneSource source(read_text(path), path, {});
  // Errors are collected in `source` and thrown together at the end, so that the user sees all of them at once.
  TableReader root(source);
  Campaign campaign;
  TableReader head = root.table("campaign", "a table with the keys scene and seeds");
  if (head) {
    Part part{head, *source.root().get("campaign")->as_table(), source};
    campaign.name =
        part.reader.text("name", "a string", Need::optional).value_or(fs::path(path).stem().string());
    if (const auto name =
            part.reader.text("scene", "the name of the scene file, relative to the campaign file"))
      campaign.scene_file = (fs::path(path).parent_path() / (scene.empty() ? *name : scene)).string();
    campaign.seeds = read_seeds(part);
    if (!campaign.scene_file.empty() && !fs::is_regular_file(campaign.scene_file))
      refuse(source, "campaign.scene", *part.get("scene"), "a scene file; there is no " + campaign.scene_file);
    part.reader.refuse_other_keys();
  }
  const std::vector<GridAxis> grid = read_grid(root, source);
  const auto listed =
      read_all(root, source, "case", "tables [[case]], each with a key named set", [](Part& part) {
        CampaignCase one;
        one.place = part.place();
        one.label = part.reader.text("name", "a string", Need::optional).value_or("");
        one.changes = read_changes(part, "set", Need::required);
        return one;
      });
  campaign.collections = read_all(root, source, "collect", "tables [[collect]]", read_collection);
  campaign.fits = read_all(root, source, "fit", "tables [[fit]]", read_fit);
  campaign.references = read_all(root, source, "reference", "tables [[reference]]", read_reference);
  campaign.promise = read_promise(root);
  root.refuse_other_keys();
  if (campaign.collections.empty() && campaign.fits.empty())
    source.fault_at(path, "this campaign collects no results: expected a [[collect]] or a [[fit]]");
  set_cases(grid, listed, path, campaign);
  check_collections(campaign, source);
  check_references(campaign, source);
  if (campaign.cases.size() * campaign.seeds.size() > kMaxRuns)
    source.fault_at(path, fmt::format("this campaign has {} cases with {} seeds: expected at most {} runs",
                                      campaign.cases.size(), campaign.seeds.size(), kMaxRuns));
  source.throw_faults();
  // The scene is not checked here: plan_cases() checks it for each case, with the changes of this case.
  campaign.scene = read_text(campaign.scene_file);
  return campaign;
}

}  // namespace floc
