// File of tests -> GoldenTests.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/file_trust.h"
#include "base/suggest.h"
#include "cli/golden/golden_keys.h"
#include "cli/golden/golden_tests.h"
#include "cli/scene/scene_parts.h"
#include "cli/scene/scene_path.h"
#include "cli/text/text_file.h"
#include "cli/yaml/yaml_changes.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

constexpr int usual_timeout = 600;  // [s]

void read_golden_version(MapReader& map) {
  const Node& node = map.require("billow_golden", "; begin it with 'billow_golden: 1'");
  if (node.quoted || !is_word(node, "1"))
    fail_at(node.where,
            "billow_golden, the version of the format of tests, must be 1: this billow reads version 1 only");
}

// Of a file or folder that stands at `where`.
fs::path trusted(const fs::path& path, const std::string& where) {
  located(where, [&] { require_trusted(path); });
  return path;
}

// 10, 1-250:5 or a list of such.
std::vector<FrameSpan> read_frames(const Node& node) {
  std::vector<FrameSpan> spans;
  const auto add = [&](const Node& item) {
    const auto read = parse_frames(read_text(item, "frames"));
    if (!read)
      fail_at(item.where,
              fmt::format("frames is '{}', and should be like 10, 1-250:5 or [1, 25, 200-]", shortened(item.text)));
    spans.insert(spans.end(), read->begin(), read->end());
  };
  if (node.kind != Node::Kind::list) return add(node), spans;
  for (const NodePtr& item : node.items) add(*item);
  if (spans.empty()) fail_at(node.where, "frames is empty; leave the key out for all frames");
  return spans;
}

// A list of words, none of them twice.
template <class Enum>
std::vector<Enum> read_words(const Node& node, std::string_view name, std::string_view one,
                             const std::vector<std::string_view>& known) {
  std::vector<Enum> values;
  for (const NodePtr& item : read_list(node, name)) {
    const std::string word = read_word(*item, one, known);
    const Enum value = read_choice<Enum>(*item, one);
    if (std::find(values.begin(), values.end(), value) != values.end())
      fail_at(item->where, fmt::format("{} has '{}' twice", name, word));
    values.push_back(value);
  }
  if (values.empty()) fail_at(node.where, fmt::format("{} is empty; name at least one, or leave the key out", name));
  return values;
}

RenderedPictures read_rendered(MapReader& map, const fs::path& folder) {
  RenderedPictures pictures;
  pictures.scene = read_scene_path(map, folder);
  if (const Node* set = map.find("set")) pictures.changes = read_changes(*set);
  pictures.frames_where = map.where("frames");
  if (const Node* frames = map.find("frames")) pictures.frames = read_frames(*frames);
  if (const Node* views = map.find("views"))
    pictures.views = read_words<render::View>(*views, "views", "view", map.key("views").choices);
  pictures.kinds_where = map.where("pictures");
  pictures.kinds = {RunPicture::frames};
  if (const Node* kinds = map.find("pictures"))
    pictures.kinds = read_words<RunPicture>(*kinds, "pictures", "picture", map.key("pictures").choices);
  return pictures;
}

MadePictures read_made(MapReader& map) {
  MadePictures pictures;
  bool has_output = false;
  const Node& command = map.require("command");
  for (const NodePtr& word : read_list(command, "command")) {
    pictures.command.push_back(read_text(*word, "a word of the command"));
    has_output = has_output || pictures.command.back().find(MadePictures::output_mark) != std::string::npos;
  }
  if (!has_output)
    fail_at(command.where, fmt::format("no argument of the command has {}, which stands for the folder that it writes "
                                       "its pictures to; add it, or test a 'folder'",
                                       MadePictures::output_mark));
  pictures.timeout = map.integer("timeout", usual_timeout);
  return pictures;
}

// Which of the keys that say where its pictures come from a test has.
std::string_view source_of(const Node& test) {
  if (test.kind != Node::Kind::map) fail_at(test.where, "a test must be a map, like {name: drape, scene: drape.yaml}");
  std::vector<std::string_view> found;
  for (const std::string_view key : {"scene", "folder", "command"})
    if (test.find(key)) found.push_back(key);
  if (found.size() == 1) return found.front();
  if (found.size() > 1)
    fail_at(
        test.find(found[1])->where,
        fmt::format("a test has one of 'scene', 'folder' and 'command', and this one has '{}' too; make it two tests",
                    found.front()));
  for (const Entry& entry : test.entries)  // most often misspelt
    if (const auto meant = closest_name(entry.key, {"scene", "folder", "command"}); !meant.empty())
      fail_at(entry.where, fmt::format("unknown key '{}' in a test; did you mean '{}'?", shortened(entry.key), meant));
  fail_at(test.where, "a test needs one of the keys 'scene', 'folder' and 'command': where its pictures come from");
}

const Section& section_of(std::string_view source) {
  return source == "scene" ? keys::golden_scene : source == "folder" ? keys::golden_folder : keys::golden_command;
}

std::string read_test_name(MapReader& map) {
  std::string name = map.text("name");
  if (!is_file_name(name)) fail_at(map.where("name"), "a test's name is up to 64 letters, digits, _ and -");
  return name;
}

ImageTolerance read_tolerance_of(MapReader& map, const fs::path& folder, const ImageTolerance& usual) {
  const Node* node = map.find("tolerance");
  if (!node) return usual;
  ImageTolerance tolerance = read_tolerance(*node, folder, usual, ReasonFor::what_is_not_stricter);
  if (const Entry* mask = node->find("mask")) {
    trusted(tolerance.mask, mask->value->where);
    std::error_code error;
    if (!fs::is_regular_file(tolerance.mask, error))
      fail_at(mask->value->where,
              fmt::format("there is no mask {}; white is what counts in it", tolerance.mask.string()));
  }
  return tolerance;
}

GoldenTest read_golden_test(const Node& node, const GoldenTests& tests) {
  const fs::path folder = tests.file.parent_path();
  const std::string_view source = source_of(node);
  MapReader map(node, section_of(source), make_map());
  GoldenTest test;
  test.name = read_test_name(map);
  if (source == "scene")
    test.pictures = read_rendered(map, folder);
  else if (source == "folder")
    test.pictures = FoundPictures{trusted(folder / map.text("folder"), map.where("folder"))};
  else
    test.pictures = read_made(map);
  test.tolerance = read_tolerance_of(map, folder, tests.tolerance);
  return test;
}

void read_tests(const Node& list, GoldenTests& tests) {
  std::map<std::string, std::string> place;  // by name, as file systems tell them apart
  for (const NodePtr& item : read_list(list, "tests")) {
    tests.tests.push_back(read_golden_test(*item, tests));
    const std::string& name = tests.tests.back().name;
    const std::string& where = item->find("name")->value->where;
    const auto [first, fresh] = place.try_emplace(lower_case(name), where);
    if (!fresh) fail_at(where, fmt::format("a second test named '{}'; the first is at {}", name, first->second));
  }
  if (tests.tests.empty())
    fail_at(list.where, "tests is empty; add at least one, like {name: drape, scene: drape.yaml}");
}

}  // namespace

Words<RunPicture> words(RunPicture) {
  static constexpr Word<RunPicture> list[] = {{"frames", RunPicture::frames},
                                              {"sheet", RunPicture::sheet},
                                              {"strip", RunPicture::strip},
                                              {"velocity_image", RunPicture::velocity_image},
                                              {"spectrum", RunPicture::spectrum}};
  return list;
}

GoldenTests read_golden_tests(const fs::path& file) {
  const NodePtr root = read_yaml_file(file);
  MapReader map(*root, keys::golden, make_map());
  read_golden_version(map);
  GoldenTests tests;
  tests.file = file;
  tests.baselines = trusted(file.parent_path() / map.text("baselines", "baselines"), map.where("baselines"));
  tests.tolerance = read_tolerance_of(map, file.parent_path(), {});
  read_tests(map.require("tests"), tests);
  return tests;
}

}  // namespace billow::cli
