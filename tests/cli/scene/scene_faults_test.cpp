// Every kind of bad scene, with the message it gets and its place.
#include <gtest/gtest.h>

#include "tests/support/scene_files.h"

namespace billow {
namespace {

// One slip in the base scene, and what is said of it.
struct Slip {
  const char* find;
  const char* replacement;
  const char* message;
};

void expect_messages(const std::vector<Slip>& slips) {
  const test::SceneFolder folder;
  for (const Slip& slip : slips) {
    SCOPED_TRACE(slip.replacement);
    const auto file = folder.scene(test::edited(test::base_scene, slip.find, slip.replacement));
    EXPECT_EQ(test::scene_error(file), slip.message);
  }
}

// Unknown, doubled and missing keys.
TEST(SceneFaults, Keys) {
  expect_messages({
      {"      stiffness: {", "      stifness: {",
       "scene.yaml:9:7: unknown key 'stifness' in cloth; did you mean 'stiffness'?"},
      {"mass: 0.2", "masss: 0.2", "scene.yaml:8:7: unknown key 'masss' in cloth; did you mean 'mass'?"},
      {"filter: {kernel", "filtre: {kernel", "scene.yaml:16:3: unknown key 'filtre' in solver; did you mean 'filter'?"},
      {"  samples: 4", "  antialiasing_quality: 4",
       "scene.yaml:20:3: unknown key 'antialiasing_quality' in render; its keys are: size, fps, samples, views, "
       "camera, ground, velocity_colour, velocity_range, velocity_shading, legend, background"},
      {"duration: 2", "duration: 2\nduration: 3",
       "scene.yaml:3:1: duplicate key 'duration'; it was first given at scene.yaml:2:1"},
      {"      mass: 0.2\n", "      mass: 0.2\n      mass: 0.3\n",
       "scene.yaml:9:7: duplicate key 'mass'; it was first given at scene.yaml:8:7"},
      {"coefficient: 0}", "coefficient: 0, coefficient: 1}",
       "scene.yaml:10:51: duplicate key 'coefficient'; it was first given at scene.yaml:10:35"},
      {"billow: 1\n", "", "scene.yaml:1:1: the scene needs the key 'billow'; begin it with 'billow: 1'"},
      {"      mesh: cloth.obj\n", "", "scene.yaml:7:7: cloth needs the key 'mesh'"},
      {"bodies:\n", "objects:\n",
       "scene.yaml:4:1: unknown key 'objects' in the scene; its keys are: billow, duration, gravity, bodies, "
       "colliders, water, wind, solver, render, caches, strip, spectrum"},
      {"duration: 2", "? [a, b]\n: 2", "scene.yaml:2:3: a key must be a word"},
      {"duration: 2", "? {a: b}\n: 2", "scene.yaml:2:3: a key must be a word"},
  });
}

// Values of the wrong kind.
TEST(SceneFaults, Kinds) {
  expect_messages({
      {"gravity: [0, -9.81, 0]", "gravity: -9.81", "scene.yaml:3:10: gravity must be a list [x, y, z], not '-9.81'"},
      {"gravity: [0, -9.81, 0]", "gravity: [0, -9.81]",
       "scene.yaml:3:10: gravity must be a list [x, y, z], but has 2 entries"},
      {"strip: {step: 0.01}", "strip: [1]", "scene.yaml:23:8: strip must be none or a map, not a list"},
      {"stiffness: {structural: 115, shear: 80, bend: 35}", "stiffness: 115",
       "scene.yaml:9:18: stiffness must be a map, not '115'"},
      {"mass: 0.2", "mass: [0.2]", "scene.yaml:8:13: mass must be a number, not a list"},
      {"mass: 0.2", "mass: {kg: 0.2}", "scene.yaml:8:13: mass must be a number, not a map"},
      {"mass: 0.2", "mass:", "scene.yaml:8:7: mass has no value"},
      {"mass: 0.2", "mass: ~", "scene.yaml:8:7: mass has no value"},
      {"colour: \"#808080\"", "colour: #808080",
       "scene.yaml:12:5: colour has no value; a colour that begins with # needs quotes"},
      {"pins: [{corner: top_left}]", "pins: top_left", "scene.yaml:11:13: pins must be a list, not 'top_left'"},
      {"pins: [{corner: top_left}]", "pins: [top_left]", "scene.yaml:11:14: pin must be a map, not 'top_left'"},
      {"mesh: cloth.obj", "mesh: [cloth.obj]", "scene.yaml:7:13: mesh must be a text, not a list"},
      {"mesh: cloth.obj", "mesh: ''", "scene.yaml:7:13: mesh is empty"},
      {"views: [textured]", "views: textured", "scene.yaml:21:10: views must be a list, not 'textured'"},
      {"strip: {step: 0.01}", "strip: yes", "scene.yaml:23:8: strip must be none or a map, not 'yes'"},
      {"filter: {kernel: exponential, lambda: 1}", "filter: exponential",
       "scene.yaml:16:11: filter must be none or a map, not 'exponential'"},
      {"camera: {eye: [0, 0, 3], look_at: [0, 0, 0], fov: 40}", "camera: fitted",
       "scene.yaml:22:11: camera must be fit or a map, not 'fitted'"},
  });
}

// Texts that other readers take for numbers, and near misses.
TEST(SceneFaults, Numbers) {
  expect_messages({
      {"mass: 0.2", "mass: abc", "scene.yaml:8:13: mass must be a number, not 'abc'"},
      {"mass: 0.2", "mass: 0,2", "scene.yaml:8:13: mass must be a number, not '0,2'; the decimal sign is a point"},
      {"mass: 0.2", "mass: 010",
       "scene.yaml:8:13: mass must be a number, not '010'; numbers are decimal and begin with no needless 0"},
      {"mass: 0.2", "mass: 0x10", "scene.yaml:8:13: mass must be a number, not '0x10'"},
      {"mass: 0.2", "mass: 1_000", "scene.yaml:8:13: mass must be a number, not '1_000'"},
      {"mass: 0.2", "mass: 2kg", "scene.yaml:8:13: mass must be a number, not '2kg'"},
      {"mass: 0.2", "mass: .nan", "scene.yaml:8:13: mass must be a finite number, not '.nan'"},
      {"mass: 0.2", "mass: nan", "scene.yaml:8:13: mass must be a finite number, not 'nan'"},
      {"mass: 0.2", "mass: -.inf", "scene.yaml:8:13: mass must be a finite number, not '-.inf'"},
      {"mass: 0.2", "mass: .INF", "scene.yaml:8:13: mass must be a finite number, not '.INF'"},
      {"mass: 0.2", "mass: inf", "scene.yaml:8:13: mass must be a finite number, not 'inf'"},
      {"mass: 0.2", "mass: 1e999",
       "scene.yaml:8:13: mass must be a number, not '1e999'; that is beyond what a number can hold"},
      {"mass: 0.2", "mass: '0.2'", "scene.yaml:8:13: mass must be a number, not \"0.2\"; leave the quotes out"},
      {"mass: 0.2", "mass: \"0.2\"", "scene.yaml:8:13: mass must be a number, not \"0.2\"; leave the quotes out"},
      {"mass: 0.2", "mass: +", "scene.yaml:8:13: mass must be a number, not '+'"},
      {"mass: 0.2", "mass: --1", "scene.yaml:8:13: mass must be a number, not '--1'"},
      {"mass: 0.2", "mass: 1e", "scene.yaml:8:13: mass must be a number, not '1e'"},
      {"mass: 0.2", "mass: 0.2.", "scene.yaml:8:13: mass must be a number, not '0.2.'"},
      {"mass: 0.2", "mass: true", "scene.yaml:8:13: mass must be a number, not 'true'"},
  });
}

// Numbers and lists that make no sense.
TEST(SceneFaults, Ranges) {
  expect_messages({
      {"mass: 0.2", "mass: 0", "scene.yaml:8:13: mass is 0 kg; it must be above 0 and at most 1000000 kg"},
      {"mass: 0.2", "mass: -1", "scene.yaml:8:13: mass is -1 kg; it must be above 0 and at most 1000000 kg"},
      {"mass: 0.2", "mass: 1e7", "scene.yaml:8:13: mass is 10000000 kg; it must be above 0 and at most 1000000 kg"},
      {"duration: 2", "duration: 0", "scene.yaml:2:11: duration is 0 s; it must be above 0 and at most 100000 s"},
      {"gravity: [0, -9.81, 0]", "gravity: [0, -98100, 0]",
       "scene.yaml:3:14: gravity[1] is -98100 m/s²; it must be at least -10000 and at most 10000 m/s²"},
      {"coefficient: 0", "coefficient: -0.1",
       "scene.yaml:10:48: coefficient is -0.1 N s/m; it must be at least 0 and at most 1000000000 N s/m"},
      {"step: auto", "step: 0", "scene.yaml:15:9: step is 0 s; it must be above 0 and at most 100000 s"},
      {"step: auto", "step: 3", "scene.yaml:15:9: step is 3 s, longer than the whole scene of 2 s"},
      {"step: auto", "step: -1e-3", "scene.yaml:15:9: step is -0.001 s; it must be above 0 and at most 100000 s"},
      {"step: auto", "step: auto\n  safety: 1.5", "scene.yaml:16:11: safety is 1.5; it must be above 0 and at most 1"},
      {"step: auto", "step: auto\n  tolerance: 0",
       "scene.yaml:16:14: tolerance is 0; it must be above 0 and at most 0.5"},
      {"step: auto", "step: auto\n  max_iterations: 0",
       "scene.yaml:16:19: max_iterations is 0; it must be at least 1 and at most 1000000"},
      {"step: auto", "step: auto\n  max_iterations: 2.5",
       "scene.yaml:16:19: max_iterations must be a whole number, not '2.5'"},
      {"step: auto", "step: auto\n  max_iterations: 99999999999",
       "scene.yaml:16:19: max_iterations is 99999999999; it must be at least 1 and at most 1000000"},
      {"lambda: 1}", "lambda: 0}",
       "scene.yaml:16:41: lambda is 0 per mean rest length; it must be above 0 and at most 1000 per mean rest length"},
      {"lambda: 1}", "lambda: 1, passes: 0}", "scene.yaml:16:52: passes is 0; it must be at least 1 and at most 100"},
      {"lambda: 1}", "lambda: 1, passes: 1e1}", "scene.yaml:16:52: passes must be a whole number, not '1e1'"},
      {"lambda: 1}", "lambda: 1, lambda_keys: [[0, 1], [1, 2], [1, 3]]}",
       "scene.yaml:16:74: lambda_keys[2] is no later than the one before it"},
      {"lambda: 1}", "lambda: 1, lambda_keys: [[0, 0]]}",
       "scene.yaml:16:62: lambda_keys[0][1] is 0; it must be above 0 and at most 1000"},
      {"lambda: 1}", "lambda: 1, lambda_keys: [0, 1]}",
       "scene.yaml:16:58: lambda_keys[0] must be a pair [time, factor]"},
      {"size: [64, 48]", "size: [64, 15]",
       "scene.yaml:18:14: height is 15 pixels; it must be at least 16 and at most 8192 pixels"},
      {"size: [64, 48]", "size: [8193, 48]",
       "scene.yaml:18:10: width is 8193 pixels; it must be at least 16 and at most 8192 pixels"},
      {"size: [64, 48]", "size: [64.5, 48]", "scene.yaml:18:10: width must be a whole number, not '64.5'"},
      {"size: [64, 48]", "size: [64]", "scene.yaml:18:9: size must be a list [width, height]"},
      {"fps: 25", "fps: 0",
       "scene.yaml:19:8: fps is 0 frames per second; it must be above 0 and at most 10000 frames per second"},
      {"duration: 2", "duration: 50000",
       "scene.yaml:19:8: 50000 s at 25 frames per second are more than 1,000,000 frames"},
      {"samples: 4", "samples: 3", "scene.yaml:20:12: unknown samples '3'; known are: 1, 2, 4, 8, 16"},
      {"fov: 40", "fov: 180", "scene.yaml:22:53: fov is 180 degrees; it must be at least 1 and at most 170 degrees"},
      {"eye: [0, 0, 3]", "eye: [0, 0, 0]", "scene.yaml:22:37: look_at is where the eye is"},
      {"eye: [0, 0, 3], ", "", "scene.yaml:22:11: camera needs both eye and look_at, or neither to be fitted"},
      {"samples: 4", "samples: 4\n  ground: ocean",
       "scene.yaml:21:11: ground must be true, false, shadow_only or a number, not 'ocean'"},
      {"samples: 4", "samples: 4\n  ground: [1]",
       "scene.yaml:21:11: ground must be true, false, shadow_only or a number, not a list"},
      {"samples: 4", "samples: 4\n  legend: yes", "scene.yaml:21:11: legend must be true or false, not 'yes'"},
      {"samples: 4", "samples: 4\n  velocity_range: 0",
       "scene.yaml:21:19: velocity_range is 0 m/s; it must be above 0 and at most 1000000 m/s"},
      {"samples: 4", "samples: 4\n  background: blue",
       "scene.yaml:21:15: background must be \"#rrggbb\", quotes included, or [r, g, b] from 0 to 1"},
      {"samples: 4", "samples: 4\n  background: {top: [0, 0, 2]}",
       "scene.yaml:21:28: top[2] is 2; it must be at least 0 and at most 1"},
      {"\"#808080\"", "\"#80808\"",
       "scene.yaml:12:13: colour must be \"#rrggbb\", quotes included, or [r, g, b] from 0 to 1"},
      {"\"#808080\"", "\"#8080gg\"",
       "scene.yaml:12:13: colour must be \"#rrggbb\", quotes included, or [r, g, b] from 0 to 1"},
      {"strip: {step: 0.01}", "strip: {step: 1e-7}",
       "scene.yaml:23:15: a column every 1.0e-07 s of 2 s are more than 1,000,000 columns"},
      {"mass: 0.2", "mass: 0.2\n      transform: {scale: 0}",
       "scene.yaml:9:26: scale is 0; it must be above 0 and at most 1000000"},
      {"mass: 0.2", "mass: 0.2\n      transform: {rotate: {axis: [0, 0, 0], angle: 30}}",
       "scene.yaml:9:34: axis has no direction: its length is 0"},
      {"mass: 0.2", "mass: 0.2\n      transform: {rotate: {axis: [0, 1, 0]}}",
       "scene.yaml:9:27: rotate needs the key 'angle'"},
      {"views: [textured]", "views: []", "scene.yaml:21:10: views is empty: list at least one, such as textured"},
      {"views: [textured]", "views: [textured, textured]", "scene.yaml:21:21: the view 'textured' is listed twice"},
  });
}

// Keys that do not go together.
TEST(SceneFaults, Pairs) {
  expect_messages({
      {"method: fb_euler\n  step: auto\n  filter: {kernel: exponential, lambda: 1}",
       "method: imex\n  filter: {target: force}",
       "scene.yaml:15:11: a force filter needs an explicit method, and imex is implicit; filter the velocity, or "
       "nothing"},
  });
}

TEST(SceneFaults, QuotesAreFineAroundWordsOnly) {
  expect_messages({
      {"method: fb_euler", "method: \"fb_euler\"", ""},
      {"step: auto", "step: 'auto'", ""},
      {"strip: {step: 0.01}", "strip: 'none'", ""},
      {"samples: 4", "samples: 4\n  legend: 'true'", "scene.yaml:21:11: legend must be true or false, not \"true\""},
  });
}

// Words that are not in an enumeration.
TEST(SceneFaults, Words) {
  expect_messages({
      {"method: fb_euler", "method: fb_eulr", "scene.yaml:14:11: unknown method 'fb_eulr'; did you mean 'fb_euler'?"},
      {"method: fb_euler", "method: leapfrog",
       "scene.yaml:14:11: unknown method 'leapfrog'; known are: forward_euler, fb_euler, verlet, rk4, backward_euler, "
       "imex"},
      {"method: fb_euler", "method: FB_Euler", "scene.yaml:14:11: unknown method 'FB_Euler'; did you mean 'fb_euler'?"},
      {"kernel: exponential", "kernel: gaussain",
       "scene.yaml:16:20: unknown kernel 'gaussain'; did you mean 'gaussian'?"},
      {"model: projected", "model: project", "scene.yaml:10:24: unknown model 'project'; did you mean 'projected'?"},
      {"corner: top_left", "corner: topleft", "scene.yaml:11:23: unknown corner 'topleft'; did you mean 'top_left'?"},
      {"views: [textured]", "views: [texture]", "scene.yaml:21:11: unknown view 'texture'; did you mean 'textured'?"},
      {"step: auto", "step: automatic", "scene.yaml:15:9: step must be auto, paper or a number, not 'automatic'"},
      {"samples: 4", "samples: 4\n  velocity_colour: rgb",
       "scene.yaml:21:20: unknown velocity_colour 'rgb'; known are: magnitude, components"},
      {"billow: 1\n", "billow: 2\n",
       "scene.yaml:1:9: billow, the version of the scene format, must be 1: this billow reads version 1 only"},
      {"billow: 1\n", "billow: '1'\n",
       "scene.yaml:1:9: billow, the version of the scene format, must be 1: this billow reads version 1 only"},
  });
}

// Bodies and their pins.
TEST(SceneFaults, Bodies) {
  expect_messages({
      {"name: sheet", "name: a.b",
       "scene.yaml:5:11: the name 'a.b' will not do: up to 64 characters, no blanks, none of . = / \\, and not digits "
       "alone"},
      {"name: sheet", "name: 12",
       "scene.yaml:5:11: the name '12' will not do: up to 64 characters, no blanks, none of . = / \\, and not digits "
       "alone"},
      {"name: sheet", "name: ''", "scene.yaml:5:11: name is empty"},
      {"name: sheet", "name: \"a\\uFFFE\"",
       "scene.yaml:5:11: the name holds a control character, or one that stands for none, such as U+FFFE; leave it "
       "out"},
      {"solver:\n", "  - name: sheet\n    cloth: {mesh: cloth.obj}\nsolver:\n",
       "scene.yaml:13:11: a second body named 'sheet'; the first is at scene.yaml:5:11"},
      {"solver:\n", "  - colour: \"#ffffff\"\nsolver:\n",
       "scene.yaml:13:5: a body needs a kind, one of the keys 'cloth', 'soft', 'fish'"},
      {"solver:\n", "  - sheet\nsolver:\n", "scene.yaml:13:5: body must be a map, not 'sheet'"},
      {"{corner: top_left}", "{}",
       "scene.yaml:11:14: a pin has one of the keys corner, vertices, box, group and weights; this one has 0"},
      {"{corner: top_left}", "{corner: top_left, group: edge}",
       "scene.yaml:11:14: a pin has one of the keys corner, vertices, box, group and weights; this one has 2"},
      {"{corner: top_left}", "{vertices: [0, 9]}",
       "scene.yaml:11:25: there is no vertex 9: the mesh has 9, numbered 0 to 8"},
      {"{corner: top_left}", "{vertices: [-1]}",
       "scene.yaml:11:26: vertex is -1; it must be at least 0 and at most 1000000000"},
      {"{corner: top_left}", "{vertices: 3}", "scene.yaml:11:25: vertices must be a list, not '3'"},
      {"{corner: top_left}", "{vertices: []}", "scene.yaml:11:25: the list of vertices is empty; name at least one"},
      {"{corner: top_left}", "{vertices: [0, 1, 2, 3, 4, 5, 6, 7, 8]}",
       "scene.yaml:11:13: the pins hold every vertex, so nothing of the body can move"},
      {"{corner: top_left}", "{box: [[0, 0, 0]]}",
       "scene.yaml:11:20: box must be a list of two corners [[x, y, z], [x, y, z]]"},
      {"{corner: top_left}", "{box: [[0, 0, 0], [1, -1, 1]]}",
       "scene.yaml:11:20: box is empty: its first corner must be the lower one in x, y and z"},
      {"{corner: top_left}", "{box: [[5, 5, 5], [6, 6, 6]]}",
       "scene.yaml:11:20: the box [5, 5, 5] to [6, 6, 6] holds no vertex: the mesh lies in [0, 0, 0] to [1, 0, 1]"},
      {"{corner: top_left}", "{group: egde}",
       "scene.yaml:11:22: there is no group 'egde' in the mesh; did you mean 'edge'? it has 'edge', 'rest'"},
  });
}

// Files that are not there or not what they should be.
TEST(SceneFaults, Files) {
  expect_messages({
      {"mesh: cloth.obj", "mesh: missing.obj", "scene.yaml:7:13: there is no mesh file missing.obj"},
      {"mesh: cloth.obj", "mesh: no/such/mesh.obj", "scene.yaml:7:13: there is no mesh file no/such/mesh.obj"},
      {"mesh: cloth.obj", "mesh: /",
       "scene.yaml:7:13: the mesh / is not a regular file; name one, or save what comes from it as one"},
      {"mesh: cloth.obj", "mesh: scene.yaml",
       "scene.yaml:7:13: cannot read mesh scene.yaml: its extension '.yaml' is none of .obj .off .stl .ply .gltf .glb; "
       "convert it to one of these"},
      {"colour:", "texture: missing.png\n    colour:", "scene.yaml:12:14: there is no texture file missing.png"},
      {"colour:", "texture: cloth.obj\n    colour:",
       "scene.yaml:12:14: cloth.obj: is neither a PNG nor a JPEG image; convert it to one of these"},
  });
}

// What is no YAML, or YAML that scenes do without.
TEST(SceneFaults, Syntax) {
  expect_messages({
      {"bend: 35}", "bend: 35", "scene.yaml:10:14: not valid YAML: end of map flow not found"},
      {"gravity: [", "gravity: ]", "scene.yaml:3:10: not valid YAML: illegal flow end"},
      {"    cloth:\n", "   cloth:\n", "scene.yaml:6:4: not valid YAML: end of sequence not found"},
      {"duration: 2", "duration: \"2",
       "scene.yaml:2:11: duration must be a number, not \"2 gravity: [0, -9.81, 0] bodies: - na...\"; leave the quotes "
       "out"},
      {"duration: 2", "duration: *two", "scene.yaml:2:11: not valid YAML: the referenced anchor is not defined"},
      {"duration: 2", "duration: &a [*a]", "scene.yaml:2:15: this alias stands inside its own anchor"},
      {"duration: 2", "duration: !!float 2",
       "scene.yaml:2:11: the tag 'tag:yaml.org,2002:float' is not understood here"},
      {"duration: 2", "\tduration: 2", "scene.yaml:2:1: not valid YAML: illegal tab when looking for indentation"},
      {"strip: {step: 0.01}\n", "---\nstrip: {}\n",
       "scene.yaml:23:1: a second YAML document begins here; a file holds one"},
      {"duration: 2", "duration: \"\\x01\"", "scene.yaml:2:11: a text with control characters"},
      {"duration: 2", "<<: 3", "scene.yaml:2:1: a merge key (<<) needs a map, or a list of maps"},
  });
}

}  // namespace
}  // namespace billow
