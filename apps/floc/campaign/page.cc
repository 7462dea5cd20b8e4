#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "campaign/commands.h"
#include "campaign/counted.h"
#include "campaign/curves.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/base/sha256.h"
#include "floc/base/version.h"
#include "floc/campaign/campaign_tables.h"
#include "floc/picture/sheet.h"
#include "floc/run_directory/one_run.h"
#include "plots/html.h"
#include "plots/pressure_text.h"
#include "plots/state_picture.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

struct PageArguments {
  std::string directory;
  std::string output;
  Printing printing;
};

/// Style and script of the page of a campaign, in addition to the style that html_page() gives to every page. A click
/// on the heading of a column sorts the table, and a check box shows or hides the curve of a case.
constexpr const char* kHead = R"(<style>
th[data-sorts] { cursor: pointer; } th[data-sorts]:hover { background: #eee; }
th[aria-sort=ascending]::after { content: " \25B2"; } th[aria-sort=descending]::after { content: " \25BC"; }
svg.curves { width: 100%; height: auto; font: 12px "DejaVu Sans", Verdana, sans-serif; fill: #202020; }
.legend label { display: inline-block; margin-right: 1.2em; white-space: nowrap; }
.legend i { display: inline-block; width: 1.6em; height: 0.5em; margin: 0 0.3em; }
td.differs { background: #fde3d3; } .pictures { display: flex; flex-wrap: wrap; gap: 1em; }
.pictures figure { flex: 0 1 20em; margin: 0.5em 0; }
</style>
<script>
document.addEventListener('click', event => {
  const heading = event.target.closest('th[data-sorts]');
  if (!heading) return;
  const column = heading.cellIndex, body = heading.closest('table').tBodies[0];
  const descending = heading.getAttribute('aria-sort') === 'ascending';
  heading.parentNode.querySelectorAll('th').forEach(th => th.removeAttribute('aria-sort'));
  heading.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
  const value = row => row.cells[column].dataset.v;
  const order = (a, b) => {
    if (a === '' || b === '') return (a === '') - (b === '');
    const both = a !== '' && b !== '' && !isNaN(a) && !isNaN(b);
    const sign = both ? a - b : a < b ? -1 : a > b ? 1 : 0;
    return descending ? -sign : sign;
  };
  Array.from(body.rows).sort((a, b) => order(value(a), value(b))).forEach(row => body.appendChild(row));
});
document.addEventListener('change', event => {
  const name = event.target.dataset.curve;
  if (name === undefined) return;
  document.querySelectorAll('g.curve').forEach(curve => {
    if (curve.dataset.case === name) curve.style.display = event.target.checked ? '' : 'none';
  });
});
</script>
)";

/// Data that the html page of a campaign shows, read from the directory of the campaign.
struct CampaignPage {
  std::string directory;
  PlannedCampaign planned;
  CsvTable runs, means, fits, outcomes;
  std::map<int, CampaignRun> drawn;  ///< first successful run of each case; the key is the number of the case

  std::vector<std::string> labels() const {
    std::vector<std::string> all;
    for (const CampaignCase& one : planned.campaign.cases) all.push_back(one.label);
    return all;
  }
};

/// Returns the indices of the columns of a table that have a value in at least one row. Columns with a dot in their
/// name are left out: they contain values of scene keys, which the table of cases already shows.
std::vector<int> used_columns(const CsvTable& table) {
  const auto is_used = [&table](int column) {
    if (table.columns()[static_cast<std::size_t>(column)].find('.') != std::string::npos) return false;
    for (int row = 0; row < table.n_rows(); ++row)
      if (!table.is_empty(row, column)) return true;
    return false;
  };
  std::vector<int> used;
  for (int column = 0; column < static_cast<int>(table.columns().size()); ++column)
    if (is_used(column)) used.push_back(column);
  return used;
}

/// Returns the html of a table cell. The cell shows a number with five significant digits; its attribute data-v
/// contains all digits of the csv file.
std::string cell_html(const std::string& column, const std::string& text) {
  const auto number = parse_number<double>(text);
  std::string classes = number ? "number" : "";
  if (column == "agrees" && text == "false") classes = "differs";
  const std::string shown = text.empty() ? "–" : number ? fmt::format("{:.5g}", *number) : html_text(text);
  return fmt::format("<td{} data-v=\"{}\">{}</td>", classes.empty() ? "" : " class=\"" + classes + "\"",
                     html_text(text), shown);
}

/// Returns the html of a table. A reader of the page can sort the rows of the table.
/// @param rows  indices of the rows of `table` that are shown
std::string sorting_table(const std::string& id, const CsvTable& table, const std::vector<int>& rows) {
  const std::vector<int> columns = used_columns(table);
  std::string out = fmt::format("<div class=\"wide\"><table id=\"{}\">\n<thead><tr>", id);
  for (const int c : columns)
    out += "<th data-sorts>" + html_text(table.columns()[static_cast<std::size_t>(c)]) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const int row : rows) {
    out += "<tr>";
    for (const int c : columns)
      out += cell_html(table.columns()[static_cast<std::size_t>(c)], table.text(row, c));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string sorting_table(const std::string& id, const CsvTable& table) {
  std::vector<int> rows;
  for (int row = 0; row < table.n_rows(); ++row) rows.push_back(row);
  return sorting_table(id, table, rows);
}

std::vector<int> rows_with(const CsvTable& table, const std::string& column,
                           bool (*holds)(const std::string&)) {
  std::vector<int> rows;
  for (int row = 0; row < table.n_rows(); ++row)
    if (holds(table.text(row, table.column(column)))) rows.push_back(row);
  return rows;
}

std::string cases_section(const Campaign& campaign) {
  if (campaign.keys.empty()) return "";
  Table table{{"case"}, {}};
  table.columns.insert(table.columns.end(), campaign.keys.begin(), campaign.keys.end());
  for (const CampaignCase& one : campaign.cases) {
    std::vector<TableValue> row = {one.label};
    for (const std::string& key : campaign.keys) row.push_back(or_undefined(value_of(one, key)));
    table.rows.push_back(std::move(row));
  }
  return "<h2>Cases</h2>\n" + html_table(table);
}

std::string failures_section(const CampaignPage& page) {
  const std::vector<int> failed =
      rows_with(page.outcomes, "outcome", [](const std::string& outcome) { return outcome != "done"; });
  if (failed.empty()) return "";
  return "<h2>Runs that failed</h2>\n<p>Their results are not in the tables and curves.</p>\n" +
         sorting_table("failed", page.outcomes, failed);
}

std::string unsuccessful_fits_section(const CampaignPage& page) {
  const Campaign& campaign = page.planned.campaign;
  Table table{{"case", "command", "exit_code", "words", "log"}, {}};
  for (const auto& [case_number, fit_number, outcome] : unsuccessful_fits(campaign, page.directory)) {
    const std::string log = path_of_fit(campaign, case_number, fit_number, page.directory) + ".log";
    table.rows.push_back({campaign.cases[static_cast<std::size_t>(case_number)].label, outcome.command,
                          std::int64_t{outcome.exit_code}, or_undefined(outcome.words),
                          fs::path(log).lexically_relative(page.directory).string()});
  }
  if (table.rows.empty()) return "";
  return fmt::format(
             "<h2>Fits without a result</h2>\n<p>A fit with exit code {} has no result for one sample or more; "
             "its other results are in the table of fits. A fit with another exit code failed.</p>\n",
             int{kNotConverged}) +
         html_table(table);
}

/// Returns whether the load path of a campaign drives one axis in some states, so that the stresses on the axes differ.
/// The pressure of such a state is the mean of these stresses.
bool has_driven_states(const PlannedCampaign& planned) {
  return std::ranges::any_of(planned.plans, [](const CasePlan& plan) {
    return std::ranges::any_of(plan.states, [](const PlannedState& state) { return !state.P_star; });
  });
}

std::string curves_section(const CampaignPage& page) {
  const std::vector<std::string> quantities = curve_quantities(page.means), labels = page.labels();
  if (quantities.empty()) return "";
  std::string out =
      "<h2>Curves</h2>\n<p>Lines are means over the samples; bands reach from the lowest to the highest "
      "sample. Dashed curves are branches of the load path after the first loading.</p>\n<p class=\"legend\">";
  for (std::size_t k = 0; k < labels.size(); ++k)
    out += fmt::format(
        "<label><input type=\"checkbox\" checked data-curve=\"{0}\"><i style=\"background: {1}\"></i>{0}"
        "</label> ",
        html_text(labels[k]), curve_colour(k));
  out += "</p>\n<div class=\"plots\">\n";
  for (const std::string& quantity : quantities)
    out += "<figure>" +
           curves_svg(page.means, quantity, labels, mean_pressure_label(has_driven_states(page.planned))) +
           "<figcaption>" + html_text(quantity) + "</figcaption></figure>\n";
  return out + "</div>\n";
}

std::string tables_section(const CampaignPage& page) {
  const auto has_value = [](const std::string& text) { return !text.empty(); };
  std::string out;
  if (const std::vector<int> compared = rows_with(page.means, "reference", has_value); !compared.empty())
    out +=
        "<h2>Compared with references</h2>\n<p>A mean agrees with its reference if they differ by at most "
        "allowed = 2.6 "
        "sqrt(s²/n + "
        "s_ref²/n_ref).</p>\n" +
        sorting_table("compared", page.means, compared);
  if (page.means.n_rows() > 0) out += "<h2>Means</h2>\n" + sorting_table("means", page.means);
  if (page.fits.n_rows() > 0) out += "<h2>Fits</h2>\n" + sorting_table("fits", page.fits);
  return out;
}

/// Returns the index of the state whose picture the page shows for this case: the state under the largest pressure or,
/// if no pressure is known, the last state.
int drawn_state(const CasePlan& plan) {
  int best = static_cast<int>(plan.states.size()) - 1;
  double highest = 0.0;
  for (int k = 0; k < static_cast<int>(plan.states.size()); ++k)
    if (const auto P = plan.states[static_cast<std::size_t>(k)].P_star; P && *P > highest) {
      highest = *P;
      best = k;
    }
  return best;
}

std::map<int, CampaignRun> drawn_runs(const Campaign& campaign, const std::string& directory) {
  std::map<int, CampaignRun> drawn;
  for (const CampaignRun& run : runs_of(campaign)) {
    if (is_done(outcome_of(directory + "/" + run.directory))) drawn.emplace(run.case_number, run);
  }
  return drawn;
}

/// Largest number of pictures on the page, one per case. Hundreds of pictures would make the page slow to open.
constexpr std::size_t kMostPictures = 24;

/// Returns the options of the pictures on the page. In 3D the spheres are drawn as pixel images, because vector
/// graphics would take megabytes per picture.
template <int Dim>
SheetOptions picture_options() {
  SheetOptions options;
  if (Dim == 3) options.width = 240.0, options.resolution = 100.0, options.as_image = true;
  return options;
}

std::string pictures_section(const CampaignPage& page) {
  std::string out;
  // If there are more cases than pictures, only some cases are drawn, evenly spread over all cases.
  const std::size_t n = page.drawn.size(), spread = std::max(n, kMostPictures);
  std::size_t k = 0;
  for (const auto& [number, run] : page.drawn) {
    const bool shown = (k + 1) * kMostPictures / spread > k * kMostPictures / spread;
    ++k;
    if (!shown) continue;
    const int step = drawn_state(page.planned.plans[static_cast<std::size_t>(number)]);
    const std::string file = state_file(page.directory + "/" + run.directory, step);
    const std::string caption =
        fmt::format("{}, seed {}, state {}",
                    page.planned.campaign.cases[static_cast<std::size_t>(number)].label, run.seed, step);
    out += std::visit(
        [&]<int Dim>(const State<Dim>& state) {
          return html_figure(
              draw_sheet<Dim>({picture_of(file, state, Shown::equilibrium)}, picture_options<Dim>()), caption);
        },
        read_state(file));
  }
  if (out.empty()) return "";
  return (n > kMostPictures ? fmt::format("<h2>One sample of {} of the {} cases</h2>", kMostPictures, n)
                            : std::string("<h2>One sample of each case</h2>")) +
         "\n<p>Lines join the centres of grains that interact; their width is proportional to the force.</p>\n"
         "<div class=\"pictures\">\n" +
         out + "</div>\n";
}

std::string cost_section(const CampaignPage& page) {
  return fmt::format(
             "<h2>Cost</h2>\n<p>The runs took {:.4g} s (wall time) to make the states, and {:.4g} s (processor "
             "time) to make tables of the states. The expected processor time was {:.4g} s.</p>\n",
             sum_of(page.outcomes, "run_seconds"), sum_of(page.outcomes, "analysis_seconds"),
             sum_of(page.outcomes, "expected_seconds")) +
         sorting_table("outcomes", page.outcomes);
}

std::string provenance_section(const CampaignPage& page) {
  Table table{{"", ""}, {}};
  table.rows.push_back({"page made by", fmt::format("floc {} ({}), {}", version(), commit(), compiler())});
  if (!page.drawn.empty()) {
    const AnyState state =
        read_state(state_file(page.directory + "/" + page.drawn.begin()->second.directory, 0));
    const Provenance& made = std::visit([](const auto& s) -> const Provenance& { return s.provenance; }, state);
    table.rows.push_back(
        {"states made by", fmt::format("{} ({}), {}", made.program, made.commit, made.compiler)});
  }
  for (const char* file : {"campaign.toml", "scene.toml", "runs.csv", "means.csv", "fits.csv"})
    table.rows.push_back({fmt::format("SHA-256 of {}", file), sha256_of_file(page.directory + "/" + file)});
  return "<h2>Provenance</h2>\n" + html_table(table) + "<h2>Campaign</h2>\n" +
         html_text(read_file(page.directory + "/campaign.toml"), "pre") + "<h2>Scene</h2>\n" +
         html_text(page.planned.campaign.scene, "pre");
}

std::string html_of(const CampaignPage& page) {
  const Campaign& campaign = page.planned.campaign;
  const auto n_done =
      rows_with(page.outcomes, "outcome", [](const std::string& o) { return o == "done"; }).size();
  const std::string title = "floc campaign: " + campaign.name;
  const std::string body =
      html_text(title, "h1") +
      html_text(fmt::format("{} with {}; {} of {} done.", counted(campaign.cases.size(), "case"),
                            counted(campaign.seeds.size(), "seed"), n_done,
                            page.outcomes.n_rows() == 1 ? "1 run is"
                                                        : fmt::format("{} runs are", page.outcomes.n_rows())),
                "p") +
      failures_section(page) + unsuccessful_fits_section(page) + cases_section(campaign) +
      curves_section(page) + tables_section(page) + pictures_section(page) + cost_section(page) +
      provenance_section(page);
  return html_page(title, body, kHead);
}

int write_page(const PageArguments& arguments) {
  const auto table = [&](const char* name) { return CsvTable::read(arguments.directory + "/" + name); };
  CampaignPage page{arguments.directory,
                    campaign_of(arguments.directory),
                    table("runs.csv"),
                    table("means.csv"),
                    table("fits.csv"),
                    table("outcomes.csv"),
                    {}};
  page.drawn = drawn_runs(page.planned.campaign, page.directory);
  const std::string html = html_of(page);
  write_output(arguments.output, html);
  print_table({{"campaign", "page", "n_cases", "n_runs", "bytes"},
               {{page.planned.campaign.name, arguments.output,
                 static_cast<std::int64_t>(page.planned.campaign.cases.size()),
                 static_cast<std::int64_t>(page.outcomes.n_rows()), static_cast<std::int64_t>(html.size())}}},
              arguments.printing);
  return kDone;
}

}  // namespace

Command add_campaign_page(CommandLine campaign) {
  CommandLine app = campaign.add_subcommand("page",
                                            "make one self-contained html page from the tables in DIR: curves, "
                                            "comparison with references, pictures, cost");
  auto arguments = std::make_shared<PageArguments>();
  app.add_option("DIR", arguments->directory,
                 "directory that floc campaign plan wrote, with the tables of the campaign")
      .required();
  app.add_option("-o,--output", arguments->output, "F.html").required();
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return write_page(*arguments); }};
}

}  // namespace floc
