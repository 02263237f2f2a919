// Plots through gnuplot.
#include "render/plot.h"

#include <cmath>
#include <cstdlib>

#include "render/png.h"
#include "sim/error.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow::render {
namespace {

namespace fs = std::filesystem;

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
            "curve,x,y\n\"FB Euler\",1,0.5\n\"FB Euler\",10,5\n\"FB Euler\",100,50\n\"a \\ $weird 'name', "
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

TEST(WritePlot, LeavesOutWhatALogarithmDoesNotHave) {
  const test::TemporaryFolder folder;
  Plot plot = two_curves();
  plot.curves[1].y = {0.0, -1.0, 2.0};
  EXPECT_NO_THROW(write_plot(plot, folder.path() / "time"));
}

TEST(WritePlot, RefusesToPlotNothing) {
  const test::TemporaryFolder folder;
  Plot plot = two_curves();
  plot.curves.clear();
  EXPECT_THROW(write_plot(plot, folder.path() / "time"), OutputError);
}

TEST(WritePlot, SaysWhatToInstall) {
  const test::TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  std::string message;
  try {
    write_plot(two_curves(), folder.path() / "time");
  } catch (const OutputError& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("install the package gnuplot-nox"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder.path() / "time.png"));
}

}  // namespace
}  // namespace billow::render
