#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "support/browser.h"
#include "support/places.h"
#include "support/run_arguments.h"
#include "support/small_run.h"

namespace floc::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Report : public SmallRun {
 protected:
  static std::string page() {
    const Outcome o = floc("report run -o report.html --format csv");
    EXPECT_EQ(o.code, 0) << o.err;
    return content_of(file("report.html"));
  }
};

TEST_F(Report, HoldsEverythingInOneFile) {
  const std::string html = page();
  EXPECT_THAT(html, StartsWith("<!DOCTYPE html>"));
  for (const char* section : {"Warnings", "Force networks", "Plots", "Consolidation", "States",
                              "Dimensionless groups", "Provenance", "Scene", "kappa", "SHA-256", "protocol = "})
    EXPECT_THAT(html, HasSubstr(section));
  // All pictures are embedded in the page as data, and the page has no script.
  const std::regex address("(src|href)=\"([a-z]+:)");
  int n = 0;
  for (std::sregex_iterator m(html.begin(), html.end(), address), end; m != end; ++m, ++n)
    EXPECT_EQ((*m)[2], "data:");
  EXPECT_EQ(n, 8);  // 3 pictures and 5 plots
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_TRUE(page() == html);
}

TEST_F(Report, RefusesWhatIsNoRun) {
  EXPECT_THAT(floc("report small.toml -o r.html").err, HasSubstr("this is not a directory"));
  const Outcome ensemble = floc("report " + source_directory() + "/data/tables/demo -o r.html");
  EXPECT_EQ(ensemble.code, 4);
  EXPECT_THAT(ensemble.err, HasSubstr("holds 8 samples"));
  EXPECT_THAT(floc("report " + source_directory() + "/data/tables/demo/seed-1 -o r.html").err,
              HasSubstr("state-0000.h5"));
  std::filesystem::copy(file("run"), file("cut"), std::filesystem::copy_options::recursive);
  std::filesystem::remove(file("cut/state-0008.h5"));
  EXPECT_THAT(floc("report cut -o r.html").err,
              HasSubstr("this directory has 8 state files, but its path.csv has 9 rows"));
  write_text(file("cut/state-0008.h5"), "no state");
  const Outcome broken = floc("report cut -o r.html");
  EXPECT_EQ(broken.code, 4);
  EXPECT_THAT(broken.err, HasSubstr("state-0008.h5"));
  EXPECT_FALSE(exists("r.html"));
  EXPECT_EQ(floc("report run -o absent/r.html").code, 1);
}

/// Fixture of the tests that need a browser.
class Browser : public Report {
 protected:
  void SetUp() override {
    if (browser().empty())
      GTEST_SKIP()
          << "NOT TESTED: no chromium is installed, so no browser read the report (.ci/deps installs it)";
  }
};

TEST_F(Browser, ShowsEveryPictureAndLogsNothing) {
  const RenderedPage rendered = render_in_browser(page(), file(""));
  EXPECT_EQ(rendered.console, "");
  EXPECT_EQ(rendered.n_images, 8);
  EXPECT_EQ(rendered.n_shown, 8);
  EXPECT_THAT(rendered.document, HasSubstr("Provenance"));
}

TEST_F(Browser, IsSeenToFailOnABrokenPictureAndAnError) {
  std::string html = page();
  const std::string svg = "data:image/svg+xml;charset=utf-8,";
  html.insert(html.find(svg) + svg.size(), "broken");
  html += "<script>console.error('heard');</script>";
  const RenderedPage rendered = render_in_browser(html, file(""));
  EXPECT_EQ(rendered.n_images, 8);
  EXPECT_EQ(rendered.n_shown, 7);
  EXPECT_THAT(rendered.console, HasSubstr("heard"));
}

TEST_F(Browser, PrintsThePage) {
  page();
  const Outcome o =
      run_arguments(browser(), {"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                                "--user-data-dir=" + file("profile"), "--print-to-pdf=" + file("report.pdf"),
                                "file://" + file("report.html")});
  EXPECT_EQ(o.code, 0);
  const std::string pdf = content_of(file("report.pdf"));
  EXPECT_THAT(pdf, StartsWith("%PDF"));
  // The PDF has several pages (A4 or letter) and contains the pictures. The pictures are vector graphics, so the PDF is
  // larger than 100 kB.
  const std::regex page_object("/Type ?/Page\\b");
  EXPECT_GT(std::distance(std::sregex_iterator(pdf.begin(), pdf.end(), page_object), std::sregex_iterator()),
            2);
  EXPECT_GT(pdf.size(), 100'000u);
}

}  // namespace
}  // namespace floc::test
