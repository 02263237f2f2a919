// What NumPy gets of a run: the arrays beside its pictures, and the table of its frames.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/mesh_files.h"
#include "tests/support/scene_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;

class RawData : public testing::Test {
 protected:
  RawData() {
    folder_.write("cloth.obj", test::mesh_file("obj", test::quad_grid(9, 9)));
    folder_.write("scene.yaml",
                  "billow: 1\nduration: 0.4\n"
                  "bodies: [{name: drape, cloth: {mesh: cloth.obj, mass: 0.05, pins: [{corner: top_left}]}}]\n"
                  "render: {size: [64, 48], samples: 1, velocity_range: 1.5}\n"
                  "strip: {step: 0.01, order: mesh}\n"
                  "spectrum: {at: 0.3, step: 0.1}\n");
    const test::ToolResult result = test::run_tool({"simulate", "scene.yaml", "-o", "run"}, folder_.path());
    EXPECT_EQ(result.status, 0) << result.errors;
  }

  // Debian's own Python, which has Debian's NumPy.
  void expect_in_python(const std::string& script) const {
    folder_.write("check.py",
                  "import csv, json, numpy as np\nrun = json.load(open('run/run.json'))\n"
                  "load = lambda name: np.load('run/' + name, allow_pickle=False)\n" +
                      script);
    const test::ToolResult result = test::run_program("/usr/bin/python3", {"check.py"}, folder_.path());
    EXPECT_EQ(result.status, 0) << result.errors;
  }

  test::TemporaryFolder folder_;
};

TEST_F(RawData, HasTheShapesThatTheRecordSays) {
  expect_in_python(
      "assert len(run['arrays']) == 3\n"
      "for said in run['arrays']:\n"
      "    array = load(said['file'])\n"
      "    assert list(array.shape) == said['shape'], said\n"
      "    assert array.dtype.str == said['dtype'], said\n"
      "    assert len(said['axes']) == array.ndim, said\n"
      "    assert np.isfinite(array).all(), said\n"
      "    assert array.flags.c_contiguous, said\n");
}

// The strip's column at a frame's time is that frame's state.
TEST_F(RawData, TheStripIsTheStatesVelocities) {
  expect_in_python(
      "strip = load('velocity_strip.npy')\n"
      "assert strip.shape == (40, 81, 3)\n"
      "for frame in range(1, 11):\n"
      "    state = np.load('run/states/frame_%04d.npz' % frame)\n"
      "    assert (strip[4 * (frame - 1)] == state['velocity'].astype('<f4')).all(), frame\n"
      "assert np.abs(strip).max() > 0.1\n");
}

// Parseval: the powers of every moment sum to the mean square speed; and the image is the state at its time.
TEST_F(RawData, TheSpectrumIsTheImages) {
  expect_in_python(
      "image = load('velocity_image.npy')\n"
      "assert image.shape == (9, 9, 3)\n"
      "strip = load('velocity_strip.npy')\n"
      "assert np.allclose(np.sort(image.reshape(81, 3), axis=0), np.sort(strip[30], axis=0), atol=1e-6)\n"
      "power = load('velocity_spectrum.npy')\n"
      "speeds = [(strip[k].astype(float) ** 2).sum() / 81 for k in (0, 10, 20, 30)]\n"
      "assert abs(power.sum() - np.mean(speeds)) < 1e-5 * np.mean(speeds)\n"
      "radial = np.genfromtxt('run/spectrum.csv', delimiter=',', names=True)\n"
      "assert abs(radial['mean_square_velocity'].sum() - power.sum()) < 1e-9 * power.sum()\n");
}

TEST_F(RawData, TheTableIsTheRecordsFrames) {
  expect_in_python(
      "rows = list(csv.DictReader(open('run/frames.csv')))\n"
      "assert len(rows) == len(run['frames']) == 10\n"
      "for row, frame in zip(rows, run['frames']):\n"
      "    assert int(row['frame']) == frame['frame']\n"
      "    assert float(row['time_s']) == frame['time']\n"
      "    assert float(row['kinetic_energy_J']) == frame['kinetic_energy']\n"
      "    assert float(row['angular_momentum_z_kg_m2_s']) == frame['angular_momentum'][2]\n"
      "    assert float(row['mean_stretch']) == frame['mean_stretch']\n"
      "    assert int(row['touching_particles']) == frame['touching_particles'] == 0\n"
      "table = np.genfromtxt('run/frames.csv', delimiter=',', names=True)\n"
      "assert table.shape == (10,) and table['kinetic_energy_J'][-1] > 0\n");
}

}  // namespace
}  // namespace billow
