// Plots through gnuplot.
#include "render/paper/plot.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "render/image/png.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow::render {
namespace {

namespace fs = std::filesystem;

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

Plot two_curves() {
  return {"Time \"against\" size",
          "particles",
          "seconds",
          true,
          true,
          true,
          {{"FB Euler", {1, 10, 100}, {0.5, 5, 50}}, {"a \\ $weird 'name', %s", {1, 10, 100}, {1, NAN, 30}}}};
}

TEST(WritePlot, WritesPictureVectorsAndData) {
  const test::TemporaryFolder folder;
  write_plot(two_curves(), folder.path() / "time");
  const Image image = read_png(folder.path() / "time.png");
  EXPECT_EQ(image.width, 1280);
  EXPECT_NE(test::read_text(folder.path() / "time.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(test::read_text(folder.path() / "time.csv"),
            "curve,x,y\nFB Euler,1,0.5\nFB Euler,10,5\nFB Euler,100,50\n\"a \\ $weird 'name', "
            "%s\",1,1\n\"a \\ $weird 'name', %s\",100,30\n");
}

TEST(WritePlot, GivesTheSameBytesTwice) {
  const test::TemporaryFolder folder;
  write_plot(two_curves(), folder.path() / "a");
  write_plot(two_curves(), folder.path() / "b");
  for (const char* end : {".png", ".svg"})
    EXPECT_EQ(test::read_text(folder.path() / (std::string("a") + end)),
              test::read_text(folder.path() / (std::string("b") + end)))
        << end;
}

// gnuplot gives what stands in backquotes to a shell, even between double quotes.
TEST(WritePlot, RunsNothingThatANameSays) {
  const test::TemporaryFolder folder;
  Plot plot = two_curves();
  const std::string command = fmt::format("`touch {}`", (folder.path() / "ran").string());
  plot.title = plot.x_label = plot.y_label = plot.curves[0].name = command;
  plot.curves[1].name = "it's \\\n & <b> $x @y {z}_2 %s \"";
  write_plot(plot, folder.path() / "time `touch ran`");
  EXPECT_FALSE(fs::exists(folder.path() / "ran"));
  const std::string svg = test::read_text(folder.path() / "time `touch ran`.svg");
  EXPECT_THAT(svg, testing::HasSubstr("`touch "));
  EXPECT_THAT(svg, testing::HasSubstr("it's \\  &amp; &lt;b> $x @y {z}_2 %s \""));
}

// Its own quotes at either end, digits behind what is written by its number, and what XML cannot hold.
TEST(WritePlot, ShowsATextAsItIs) {
  const test::TemporaryFolder folder;
  for (const auto& [text, shown] :
       std::vector<std::pair<std::string, std::string>>{{"'a", "'a"},
                                                        {"''", "''"},
                                                        {"\"\"", "\"\""},
                                                        {"+1 -12 λ0", "+1 -12 λ0"},
                                                        {"a ]]> b", "a ]]&gt; b"},
                                                        {"\uFFFE\x01\xff", "\uFFFD\uFFFD\uFFFD"},
                                                        {"{/Symbol a}_2^3", "{/Symbol a}_2^3"}}) {
    SCOPED_TRACE(text);
    Plot plot = two_curves();
    plot.title = plot.x_label = plot.y_label = plot.curves[0].name = text;
    write_plot(plot, folder.path() / "text");
    const std::string svg = test::read_text(folder.path() / "text.svg");
    EXPECT_EQ(count_of(svg, ">" + shown + "</text>"), 4u);
  }
}

// A value that is not a number parts the curve in two.
TEST(WritePlot, LeavesAGapWhereThereIsNoNumber) {
  const test::TemporaryFolder folder;
  Plot whole{"", "x", "y", false, false, false, {{"c", {0, 1, 2, 3, 4}, {1, 2, 3, 2, 1}}}}, gap = whole;
  gap.curves[0].y[2] = NAN;
  write_plot(whole, folder.path() / "whole");
  write_plot(gap, folder.path() / "gap");
  EXPECT_NE(test::read_text(folder.path() / "gap.svg"), test::read_text(folder.path() / "whole.svg"));
  EXPECT_EQ(test::read_text(folder.path() / "gap.csv"), "curve,x,y\nc,0,1\nc,1,2\nc,3,2\nc,4,1\n");
}

// At most two show below the uppermost.
TEST(WritePlot, NamesCurvesThatOthersCoverWhole) {
  const test::TemporaryFolder folder;
  Plot plot{"", "x", "y", false, true, true, {}};
  for (const char* name : {"a", "b", "c", "d", "e"}) plot.curves.push_back({name, {0, 1}, {1e-3, 1}});
  write_plot(plot, folder.path() / "same");
  EXPECT_THAT(test::read_text(folder.path() / "same.svg"), testing::HasSubstr(">Covered: a; b as c.</text>"));
  plot.curves[0].y = {1e-4, 1};  // as far away as another decade, little as that is of the whole axis
  plot.curves[1].y = {1e-2, 1};
  write_plot(plot, folder.path() / "apart");
  EXPECT_THAT(test::read_text(folder.path() / "apart.svg"), testing::Not(testing::HasSubstr("Covered")));
}

Plot thirty_six_curves() {
  Plot plot{"36 curves", "x", "y", false, false, true, {}};
  plot.dimensions = {{{"RK4", "Verlet", "FB Euler"}}, {{"plain", "symmetric", "conserving"}}, {{"a", "b", "c", "d"}}};
  for (int m = 0; m < 3; ++m)
    for (int f = 0; f < 3; ++f)
      for (int l = 0; l < 4; ++l)
        plot.curves.push_back({fmt::format("{}{}{}", m, f, l), {0, 1, 2}, {1.0 * m, 0.5 * f + m, 0.3 * l}, {m, f, l}});
  return plot;
}

// A name for each colour, each mark and each panel, none for each of 36 curves.
TEST(WritePlot, SplitsManyCurvesIntoPanelsWithOneLegend) {
  const test::TemporaryFolder folder;
  write_plot(thirty_six_curves(), folder.path() / "many");
  const std::string svg = test::read_text(folder.path() / "many.svg");
  for (const char* name : {"RK4", "Verlet", "FB Euler", "plain", "symmetric", "conserving", "a", "b", "c", "d"})
    EXPECT_EQ(count_of(svg, fmt::format(">{}</text>", name)), 1u) << name;
  EXPECT_EQ(count_of(test::read_text(folder.path() / "many.csv"), "\n"), 1u + 36 * 3);
}

TEST(WritePlot, GivesQuantitiesThatShareNoScaleAxesOfTheirOwn) {
  const test::TemporaryFolder folder;
  Plot plot{"", "x", "", false, false, true, {{"e", {1, 2}, {1e-3, 2e-3}, {0}}, {"k", {1, 2}, {5000, 9000}, {1}}}};
  plot.dimensions = {{{"error [m]", "energy [J]"}, true}};
  write_plot(plot, folder.path() / "two");
  const std::string svg = test::read_text(folder.path() / "two.svg");
  for (const char* text : {"error [m]", "energy [J]", "0.0010", "9,000"})
    EXPECT_THAT(svg, testing::HasSubstr(fmt::format(">{}</text>", text)));
}

TEST(WritePlot, NamesWhatXCounts) {
  const test::TemporaryFolder folder;
  Plot plot{"", "solver", "y", false, false, true, {{"c", {0, 1}, {1, 2}}}};
  plot.x_names = {"100 %s", "=cmd|x"};
  write_plot(plot, folder.path() / "names");
  EXPECT_EQ(test::read_text(folder.path() / "names.csv"), "curve,x,y\nc,100 %s,1\nc,'=cmd|x,2\n");
  for (const char* name : {"100 %s", "=cmd|x"})
    EXPECT_THAT(test::read_text(folder.path() / "names.svg"), testing::HasSubstr(fmt::format(">{}</text>", name)));
}

TEST(WritePlot, HasItsNote) {
  const test::TemporaryFolder folder;
  Plot plot = two_curves();
  plot.note = "Not shown: run 3.";
  write_plot(plot, folder.path() / "note");
  EXPECT_EQ(count_of(test::read_text(folder.path() / "note.svg"), ">Not shown: run 3.</text>"), 1u);
}

TEST(WritePlot, LaysOutManyPanelsAndRefusesTooMany) {
  Plot plot{"", "x", "y", false, false, true, {}};
  plot.dimensions = {{std::vector<std::string>(7, "a")}, {std::vector<std::string>(1000, "b"), true}};
  for (int p = 0; p < 1000; ++p) plot.curves.push_back({"c", {0, 1}, {0, 1}, {0, p}});
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_plot(plot, folder.path() / "huge"), InputError);
  plot.curves.resize(60);
  write_plot(plot, folder.path() / "large");
  EXPECT_GT(read_png(folder.path() / "large.png").height, 5000);
}

TEST(WritePlot, ShowsACurveThatAnotherCovers) {
  const test::TemporaryFolder folder;
  Plot plot{"", "x", "y", false, false, true, {{"under", {0, 1, 2}, {1, 2, 1}}, {"over", {0, 1, 2}, {1, 2, 1}}}};
  write_plot(plot, folder.path() / "same");
  plot.curves[1].y[1] = 1.5;
  write_plot(plot, folder.path() / "other");
  EXPECT_THAT(test::read_text(folder.path() / "same.svg"), testing::HasSubstr("stroke-width=\"5.00\""));
  EXPECT_THAT(test::read_text(folder.path() / "other.svg"), testing::Not(testing::HasSubstr("stroke-width=\"5.00\"")));
}

// Letters of a title that say what only a tag may.
TEST(WritePlot, ChangesNoTextForItsBoldFace) {
  const test::TemporaryFolder folder;
  Plot plot = two_curves();
  plot.title = "font-family=\"DejaVu Sans:Bold\"";
  write_plot(plot, folder.path() / "bold");
  const std::string svg = test::read_text(folder.path() / "bold.svg");
  EXPECT_THAT(svg, testing::HasSubstr(">font-family=\"DejaVu Sans:Bold\"</text>"));
  EXPECT_THAT(svg, testing::HasSubstr("font-weight=\"bold\""));
}

/// The pictures' and the table's text of a plot.
struct Written {
  std::string svg, csv;
};

Written written(const Plot& plot) {
  const test::TemporaryFolder folder;
  write_plot(plot, folder.path() / "time");
  return {test::read_text(folder.path() / "time.svg"), test::read_text(folder.path() / "time.csv")};
}

Plot logarithms_of(const std::vector<double>& x, const std::vector<double>& y) {
  return {"", "x", "y", true, true, true, {{"whole", {1, 10, 100}, {1, 2, 3}}, {"lacking", x, y}}};
}

// A picture without what is not there, and all of it in the table.
TEST(WritePlot, LeavesOutWhatALogarithmDoesNotHave) {
  const std::vector<double> x = {1, 10, 100}, lacking_x = {-1, 0, 100};
  const std::vector<double> y = {4, 5, 6}, lacking_y = {0, -1, 6};
  const Written gap = written(logarithms_of(x, {NAN, NAN, 6}));
  for (const auto& [plot, rows] :
       {std::pair{logarithms_of(x, lacking_y), "lacking,1,0\nlacking,10,-1\nlacking,100,6\n"},
        {logarithms_of(lacking_x, y), "lacking,-1,4\nlacking,0,5\nlacking,100,6\n"}}) {
    const Written picture = written(plot);
    EXPECT_EQ(picture.svg, gap.svg) << "as if there were no number";
    EXPECT_THAT(picture.csv, testing::EndsWith(rows));
  }
  EXPECT_NE(written(logarithms_of(x, y)).svg, gap.svg) << "the test must be able to tell";
}

// gnuplot alone would refuse to draw any curve then.
TEST(WritePlot, DrawsTheOtherCurvesWhereOneHasNoLogarithmAtAll) {
  const Written picture = written(logarithms_of({1, 10, 100}, {0, -1, -2}));
  EXPECT_THAT(picture.svg, testing::HasSubstr(">whole<"));
  EXPECT_THAT(picture.svg, testing::Not(testing::HasSubstr("lacking")));
  EXPECT_THAT(picture.csv, testing::HasSubstr("lacking,100,-2"));
}

TEST(WritePlot, RefusesToPlotNothing) {
  const test::TemporaryFolder folder;
  Plot plot = two_curves();
  plot.curves.clear();
  EXPECT_THROW(write_plot(plot, folder.path() / "time"), OutputError);
}

// What write_plot throws where programs are looked for in `folder` alone.
std::string fault_with_programs_of(const fs::path& folder) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.c_str(), 1);
  std::string message;
  try {
    write_plot(two_curves(), folder / "time");
  } catch (const OutputError& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(fs::exists(folder / "time.png"));
  return message;
}

TEST(WritePlot, SaysWhatToInstall) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(fault_with_programs_of(folder.path()), testing::HasSubstr("install the package gnuplot-nox"));
}

// gnuplot repeats the command before it says what is wrong with it.
TEST(WritePlot, SaysWhatGnuplotFindsWrong) {
  const test::TemporaryFolder folder;
  const fs::path program = folder.path() / "gnuplot";
  std::ofstream(program)
      << "#!/bin/sh\nprintf \"\\ngnuplot> set key title 'line 1: x'\\n   ^\\n     line 0: unknown key "
         "option\\n\\n\" >&2\nexit 1\n";
  fs::permissions(program, fs::perms::owner_all);
  EXPECT_THAT(fault_with_programs_of(folder.path()),
              testing::EndsWith("time.png cannot be plotted: gnuplot says: unknown key option"));
}

}  // namespace
}  // namespace billow::render
