#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "floc/io/csv.h"
#include "support/browser.h"
#include "support/small_campaign.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

/// Fixture: a campaign of two cases with two seeds each. The test calls the commands of the Snakefile itself, and so
/// does not need snakemake.
class CampaignPage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    write_text(file("small.toml"), small_scene());
    std::string text = small_campaign();
    text.replace(text.find("contact.rolling.coefficient = [0.005, 0.01]"), 43, "grains.count = [40]");
    text.replace(text.find("1..3"), 4, "1..2");
    write_text(file("c.toml"), text);
    ASSERT_EQ(floc("campaign plan c.toml -o c").code, 0);
    for (const char* friction : {"0.2", "0.5"})
      for (const char* seed : {"1", "2"}) {
        std::string call = std::string("campaign run scene.toml --seed ") + seed +
                           " --set grains.count=40 --set contact.friction.coefficient=" + friction +
                           " -o runs/coefficient=" + friction + "_count=40/seed-" + seed;
        for (const char* one : {"2-moduli.csv: moduli state-0004.h5 state-0007.h5",
                                "0008-3-compare.csv: compare state-0001.h5 state-0008.h5"})
          call += std::string(" --table '") + one + "'";
        ASSERT_EQ(run_floc(call, file("c")).code, 0);
      }
    for (const char* name : {"runs", "means", "fits", "outcomes"})
      write_text(file(std::string("c/") + name + ".csv"),
                 floc(std::string("campaign collect c --format csv --table ") + name).out);
    const Outcome made = floc("campaign page c -o page.html");
    ASSERT_EQ(made.code, 0) << made.err;
  }
  static void TearDownTestSuite() { delete scratch_; }

  static Outcome floc(const std::string& arguments) { return run_floc(arguments, scratch_->path()); }
  static std::string file(const std::string& name) { return scratch_->file(name); }
  static std::string page() { return content_of(file("page.html")); }

  inline static ScratchDirectory* scratch_ = nullptr;
};

TEST_F(CampaignPage, HoldsEverythingInOneFile) {
  const std::string html = page();
  for (const char* section : {"Curves", "Compared with references", "Means", "Fits", "One sample of each case",
                              "Cost", "Provenance", "SHA-256 of runs.csv", "[[collect]]", "protocol = "})
    EXPECT_THAT(html, HasSubstr(section));
  EXPECT_THAT(html, Not(HasSubstr("Runs that failed")));
  const std::regex address("(src|href)=\"([a-z]+:)");
  int n = 0;
  for (std::sregex_iterator m(html.begin(), html.end(), address), end; m != end; ++m, ++n)
    EXPECT_EQ((*m)[2], "data:");
  EXPECT_EQ(n, 2);  // two cases with one picture each
  EXPECT_THAT(html, Not(AnyOf(HasSubstr("url(http"), HasSubstr("@import"), HasSubstr("fetch("))));
}

/// Script that is added to the page. After the page has been loaded, the script clicks as a reader would. It then
/// writes the visible content of the page into the document, as JSON.
constexpr const char* kClicks = R"(<pre id="seen"></pre><script>addEventListener('load', () => {
  const seen = {};
  const table = document.getElementById('means');
  const headings = Array.from(table.tHead.rows[0].cells);
  const columns = headings.map(h => h.textContent);
  const values = name => Array.from(table.tBodies[0].rows, row => row.cells[columns.indexOf(name)].dataset.v);
  const heading = name => headings[columns.indexOf(name)];
  seen.columns = columns;
  seen.cells = Array.from(table.tBodies[0].rows, row => Array.from(row.cells, cell => cell.dataset.v));
  heading('mean').click();
  seen.ascending = values('mean');
  seen.ascending_says = heading('mean').getAttribute('aria-sort');
  heading('mean').click();
  seen.descending = values('mean');
  heading('quantity').click();
  seen.by_quantity = values('quantity');
  seen.mean_says = heading('mean').getAttribute('aria-sort');
  const shown = name => Array.from(document.querySelectorAll('g.curve'))
    .filter(g => g.dataset.case === name && g.getBoundingClientRect().width > 10).length;
  const boxes = Array.from(document.querySelectorAll('input[data-curve]'));
  seen.curves = boxes.map(box => box.dataset.curve);
  const first = seen.curves[0], second = seen.curves[1];
  seen.before = [shown(first), shown(second)];
  boxes[0].click();
  seen.off = [shown(first), shown(second)];
  boxes[0].click();
  seen.on = [shown(first), shown(second)];
  document.getElementById('seen').textContent = JSON.stringify(seen);
});</script>)";

class CampaignInBrowser : public CampaignPage {
 protected:
  void SetUp() override {
    if (browser().empty())
      GTEST_SKIP()
          << "NOT TESTED: no chromium is installed, so no browser read the page (.ci/deps installs it)";
    rendered_ = render_in_browser(page(), scratch_->path(), kClicks);
    std::smatch match;
    ASSERT_TRUE(std::regex_search(rendered_.document, match, std::regex("<pre id=\"seen\">([^<]*)</pre>")));
    seen_ = json::parse(match[1].str());
  }

  RenderedPage rendered_;
  json seen_;
};

std::vector<double> as_numbers(const json& texts) {
  std::vector<double> numbers;
  for (const json& text : texts) numbers.push_back(std::stod(text.get<std::string>()));
  return numbers;
}

TEST_F(CampaignInBrowser, SortsATableByAClickOnAHeadingAndBackByAnother) {
  EXPECT_EQ(rendered_.console, "");
  std::vector<double> up = as_numbers(seen_.at("ascending")), down = as_numbers(seen_.at("descending"));
  EXPECT_FALSE(std::ranges::is_sorted(as_numbers([&] {
    json unsorted = json::array();
    const auto columns = seen_.at("columns").get<std::vector<std::string>>();
    const auto mean = std::ranges::find(columns, "mean") - columns.begin();
    for (const json& row : seen_.at("cells")) unsorted.push_back(row.at(static_cast<std::size_t>(mean)));
    return unsorted;
  }())));
  EXPECT_TRUE(std::ranges::is_sorted(up));
  EXPECT_EQ(seen_.at("ascending_says"), "ascending");
  std::ranges::reverse(down);
  EXPECT_EQ(up, down);
  EXPECT_TRUE(std::ranges::is_sorted(seen_.at("by_quantity").get<std::vector<std::string>>()));
  EXPECT_TRUE(seen_.at("mean_says").is_null());
}

TEST_F(CampaignInBrowser, SwitchesTheCurvesOfACaseOffAndOn) {
  EXPECT_THAT(seen_.at("curves"), SizeIs(2));
  EXPECT_EQ(seen_.at("before"), json({4, 4}));  // four curves: phi, z, B and n_negative
  EXPECT_EQ(seen_.at("off"), json({0, 4}));
  EXPECT_EQ(seen_.at("on"), json({4, 4}));
  EXPECT_EQ(rendered_.n_images, 2);
  EXPECT_EQ(rendered_.n_shown, 2);
}

TEST_F(CampaignInBrowser, ShowsTheNumbersOfTheCsv) {
  const CsvTable means = CsvTable::read(file("c/means.csv"));
  const auto columns = seen_.at("columns").get<std::vector<std::string>>();
  ASSERT_EQ(seen_.at("cells").size(), static_cast<std::size_t>(means.n_rows()));
  for (int row = 0; row < means.n_rows(); ++row)
    for (std::size_t k = 0; k < columns.size(); ++k)
      EXPECT_EQ(seen_.at("cells").at(static_cast<std::size_t>(row)).at(k),
                means.text(row, means.column(columns[k])));
  // The cells of the table show five digits, but the attribute data-v, by which rows are sorted, has all digits.
  EXPECT_THAT(page(), HasSubstr("data-v=\"" + means.text(0, means.column("mean")) + "\">" +
                                fmt::format("{:.5g}", means.number(0, means.column("mean"))) + "</td>"));
}

}  // namespace
}  // namespace floc::test
