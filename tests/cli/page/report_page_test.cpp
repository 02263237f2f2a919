// Pages as text: scripts, templates, the plots' numbers, and what a run's page says.
#include "cli/page/report_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "cli/run/film.h"
#include "cli/run/run_page.h"

namespace billow {
namespace {

using cli::FrameRecord;
using cli::Quantity;
using cli::RunPage;
using cli::RunSeries;
using testing::HasSubstr;
using testing::Not;

FrameRecord record(long frame, double kinetic, double potential = 0.0) {
  return {frame,     static_cast<double>(frame - 1) / 25.0, kinetic,
          potential, Eigen::Vector3d(1.0, 0.0, -kinetic),   Eigen::Vector3d::Zero()};
}

RunSeries series(long frames) {
  RunSeries result;
  for (long f = 1; f <= frames; ++f) result.add(record(f, 1.0 + std::sin(0.001 * static_cast<double>(f))));
  return result;
}

RunPage small_page() {
  RunPage page;
  page.title = "drape";
  page.views = {"textured", "velocity"};
  page.width = 96;
  page.height = 64;
  page.fps = 25.0;
  page.frames = 11;
  page.series = series(11);
  page.strip_columns = 22;
  page.strip_step = 0.02;
  page.facts = {{"Method", "fb_euler"}};
  page.command = "billow render scene.yaml";
  return page;
}

TEST(ReportPage, KeepsJsonFromEndingItsScript) {
  EXPECT_EQ(cli::json_for_script(R"({"name":"</script><!--"})"), R"({"name":"\u003c/script>\u003c!--"})");
}

TEST(ReportPage, FillsATemplateOnceAndWhole) {
  EXPECT_EQ(cli::fill_template("{{a}}-{{b}}-{{a}}", {{"a", "{{b}}"}, {"b", "2"}}), "{{b}}-2-{{b}}");
  EXPECT_THROW(cli::fill_template("{{c}}", {{"a", "1"}}), std::logic_error);
  EXPECT_THROW(cli::fill_template("{{a", {{"a", "1"}}), std::logic_error);
}

TEST(RunSeries, KeepsAShortRunAsItIs) {
  const std::vector<cli::PlotPoint> points = series(1000).points(Quantity::kinetic);
  ASSERT_EQ(points.size(), 1000u);
  EXPECT_TRUE(series(1000).exact());
  EXPECT_EQ(points[499].time, 499 / 25.0);
  EXPECT_EQ(points[499].value, 1.0 + std::sin(0.5));
}

// One frame of 100,000 with a peak and one with a dip: both must be in the plot, at their times.
TEST(RunSeries, LosesNoPeakOfALongRunInBoundedSpace) {
  RunSeries run;
  for (long f = 1; f <= 100000; ++f) {
    run.add(record(f, f == 76543 ? 9.0 : f == 1234 ? -3.0 : 1.0, 0.5));
    if (f % 997 == 0) {
      ASSERT_LE(run.points(Quantity::total).size(), static_cast<std::size_t>(RunSeries::max_points));
    }
  }
  for (const Quantity quantity : {Quantity::kinetic, Quantity::total, Quantity::linear_z}) {
    const std::vector<cli::PlotPoint> points = run.points(quantity);
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](auto a, auto b) { return a.time < b.time; }));
    const auto less = [](auto a, auto b) { return a.value < b.value; };
    const auto low = std::min_element(points.begin(), points.end(), less);
    const auto high = std::max_element(points.begin(), points.end(), less);
    EXPECT_EQ(std::min(low->time, high->time), 1233 / 25.0);
    EXPECT_EQ(std::max(low->time, high->time), 76542 / 25.0);
  }
  EXPECT_FALSE(run.exact());
  EXPECT_EQ(run.first_frame(), 1);
  EXPECT_EQ(run.last_frame(), 100000);
}

TEST(LinePlot, PutsRoundNumbersAroundTheValues) {
  const auto axis_of = [](double low, double high) {
    return cli::value_axis({{"", "1", {{0.0, low}, {1.0, high}, {2.0, NAN}}}});
  };
  const cli::ValueAxis plain = axis_of(-0.93, 1.17);
  EXPECT_EQ(plain.step, 1.0);
  EXPECT_EQ(plain.low, -1.0);
  EXPECT_EQ(plain.high, 2.0);
  const cli::ValueAxis tiny = axis_of(0.0, 3.9e-7);
  EXPECT_EQ(tiny.exponent, -9);
  EXPECT_NEAR(tiny.high, 400.0, 1e-9);
  for (const double constant : {0.0, -7.0, 2e9}) {
    const cli::ValueAxis axis = axis_of(constant, constant);
    EXPECT_LT(axis.low * std::pow(10.0, axis.exponent), constant);
    EXPECT_GT(axis.high * std::pow(10.0, axis.exponent), constant);
  }
}

TEST(LinePlot, TicksTheTimeAxisWithinItsEnds) {
  const cli::TimeTicks ticks = cli::time_ticks(0.96, 2.04);
  EXPECT_EQ(ticks.decimals, 1);
  EXPECT_NEAR(ticks.times.front(), 1.0, 1e-12);
  EXPECT_NEAR(ticks.times.back(), 2.0, 1e-12);
  EXPECT_LE(cli::time_ticks(0.0, 86400.0).times.size(), 11u);
}

TEST(RunPage, ShowsFramesStripPlotsAndCommand) {
  const std::string html = cli::run_page_html(small_page());
  for (const char* part : {"src=\"textured/frame_00", "src=\"velocity/frame_00", "src=\"velocity_strip.png\"", "Energy",
                           "Angular momentum", "fb_euler", "billow render scene.yaml"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(html, Not(HasSubstr("class=\"note")));
  EXPECT_THAT(html, Not(HasSubstr("http")));
}

TEST(RunPage, EscapesEveryTextOfARun) {
  RunPage page = small_page();
  const std::string text = "a<b>\"c\"&'d'</script>";
  page.title = page.summary = page.command = page.scene = text;
  page.notes = {{cli::PageNote::Kind::partial, text}};
  page.no_views = text;
  page.facts = {{text, text}};
  const std::string html = cli::run_page_html(page);
  EXPECT_THAT(html, Not(HasSubstr("a<b>")));
  EXPECT_THAT(html, HasSubstr("<h1>a&lt;b&gt;&quot;c&quot;&amp;&#39;d&#39;&lt;/script&gt;</h1>"));
}

TEST(RunPage, SaysFirstThatARunFailed) {
  RunPage page = small_page();
  page.notes = {{cli::PageNote::Kind::failed, "the simulation diverged at step 7"}};
  const std::string html = cli::run_page_html(page);
  const std::size_t note = html.find("<p class=\"note bad\">the simulation diverged at step 7</p>");
  ASSERT_NE(note, std::string::npos);
  EXPECT_LT(note, html.find("<section class=\"player\""));
}

TEST(RunPage, CopesWithoutFramesStripOrSecondView) {
  RunPage page = small_page();
  page.strip_columns = 0;
  page.views = {"velocity"};
  std::string html = cli::run_page_html(page);
  EXPECT_THAT(html, Not(HasSubstr("velocity_strip.png")));
  EXPECT_THAT(html, Not(HasSubstr("textured/")));
  page.series = {};
  html = cli::run_page_html(page);
  EXPECT_THAT(html, Not(HasSubstr("<section class=\"player\"")));
  EXPECT_THAT(html, HasSubstr("billow render scene.yaml"));
}

// A range of frames: the strip still begins at 0, so it starts left of the axis and is cut off there.
TEST(RunPage, AlignsTheStripWithARangeOfFrames) {
  RunPage page = small_page();
  page.series = {};
  for (long f = 6; f <= 11; ++f) page.series.add(record(f, 1.0));
  const std::string html = cli::run_page_html(page);  // from 0.2 s to the strip's end at 0.44 s
  EXPECT_THAT(html, HasSubstr("left: -83.3333%; width: 183.3333%"));
  EXPECT_THAT(html, HasSubstr("min=\"6\" max=\"11\""));
  EXPECT_THAT(html, HasSubstr("<div class=\"track\" style=\"width: 83.3333%\">"));
}

TEST(RunPage, CountsFramesOfTheWholeRun) {
  RunPage page = small_page();
  page.frames = 250;
  page.series = {};
  for (long f = 61; f <= 70; ++f) page.series.add(record(f, 1.0));
  EXPECT_THAT(cli::run_page_html(page), HasSubstr("frame 61 of 250</output>"));
}

// The strip whole, what it is and where the frame stands in it; values in place of curves; nothing to play.
TEST(RunPage, ShowsASingleFrameWithoutCurves) {
  RunPage page = small_page();
  page.frames = 250;
  page.series = {};
  page.series.add(record(11, 3.25));
  std::string html = cli::run_page_html(page);
  EXPECT_THAT(html, HasSubstr("One frame makes no curve."));
  EXPECT_THAT(html, HasSubstr("kinetic <output>3.25</output>"));
  EXPECT_THAT(html, Not(HasSubstr("<polyline")));
  EXPECT_THAT(html, HasSubstr("<div class=\"lane scrub\" hidden>"));
  EXPECT_THAT(html, HasSubstr("left: 0.0000%; width: 100.0000%"));
  EXPECT_THAT(html, HasSubstr("<div class=\"lane times\" aria-hidden=\"true\">"));
  page.strip_columns = 0;
  EXPECT_THAT(cli::run_page_html(page), HasSubstr("<div class=\"lane times\" aria-hidden=\"true\" hidden>"));
}

TEST(RunPage, SaysWhyThereIsNoCurve) {
  RunPage page = small_page();
  page.series = {};
  for (long f = 1; f <= 3; ++f) page.series.add(record(f, NAN, NAN));
  EXPECT_THAT(cli::run_page_html(page), HasSubstr("No value is finite."));
  page.series = {};  // of a run that failed
  page.listed = {1, 2, 3};
  const std::string html = cli::run_page_html(page);
  EXPECT_THAT(html, HasSubstr("Without curves: "));
  EXPECT_THAT(html, HasSubstr("min=\"1\" max=\"3\""));
}

TEST(RunPage, MarksFramesThatStandAlone) {
  RunPage page = small_page();
  EXPECT_THAT(cli::run_page_html(page), Not(HasSubstr("class=\"dots")));
  page.scattered = true;
  EXPECT_THAT(cli::run_page_html(page), HasSubstr("class=\"dots line-1\""));
  page.series = series(1000);  // one beside the other
  EXPECT_THAT(cli::run_page_html(page), Not(HasSubstr("class=\"dots")));
}

TEST(RunPage, StaysSmallForALongRun) {
  RunPage page = small_page();
  page.series = series(10000);
  EXPECT_LT(cli::run_page_html(page).size(), 400000u);
}

}  // namespace
}  // namespace billow
