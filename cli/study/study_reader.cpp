// Study file -> Study.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/suggest.h"
#include "cli/scene/scene_parts.h"
#include "cli/scene/scene_path.h"
#include "cli/study/axis_text.h"
#include "cli/study/study.h"
#include "cli/study/study_keys.h"
#include "cli/study/study_results.h"
#include "cli/text/number_text.h"
#include "cli/text/text_file.h"
#include "cli/yaml/yaml_changes.h"

namespace billow::cli {
namespace {

constexpr std::size_t max_runs = 10'000;

void read_version(MapReader& map) {
  const Node& node = map.require("billow_study", "; begin it with 'billow_study: 1'");
  if (node.quoted || !is_word(node, "1"))
    fail_at(node.where, "billow_study, the version of the study format, must be 1: this billow reads version 1 only");
}

// With `key`: a value of that key, and its own label.
AxisValue read_keyed_value(const Node& node, const std::string& key, const std::string& axis_label) {
  if (node.kind == Node::Kind::null) fail_at(node.where, "an axis's value is empty");
  const std::string label = to_yaml_line(node), shown = shown_value(axis_label, label);
  return {label, shown, shown, {{key, label, std::make_shared<Node>(node), node.where}}};
}

AxisValue read_labelled_value(const Node& node, const std::string& axis_label) {
  MapReader map(node, keys::axis_value, make_map());
  AxisValue value;
  value.label = map.text("label");
  value.shown = shown_value(axis_label, value.label);
  value.curve = map.text("curve", value.shown);
  if (const Node* set = map.find("set")) value.changes = read_changes(*set);
  return value;
}

void check_labels(const Axis& axis, const std::vector<NodePtr>& items) {
  for (std::size_t i = 1; i < items.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (axis.values[i].label == axis.values[j].label)
        fail_at(items[i]->where, fmt::format("a second value '{}' of the axis '{}'; the first is at {}",
                                             axis.values[i].label, axis.name, items[j]->where));
}

Axis read_axis(const Node& node) {
  MapReader map(node, keys::axis, make_map());
  Axis axis;
  axis.name = map.text("name");
  if (!is_file_name(axis.name)) fail_at(map.where("name"), "an axis's name is letters, digits, _ and - only");
  if (find_column(axis.name))
    fail_at(map.where("name"), fmt::format("'{}' is a column of the results; call the axis differently", axis.name));
  const Node* key_node = map.find("key");
  const std::string key = key_node ? read_text(*key_node, "key") : "";
  axis.label = map.text("label", default_axis_label(axis.name, key));
  const std::vector<NodePtr>& items = read_list(map.require("values"), "values");
  if (items.empty()) fail_at(map.where("values"), "an axis needs at least one value");
  for (const NodePtr& item : items)
    axis.values.push_back(key_node ? read_keyed_value(*item, key, axis.label) : read_labelled_value(*item, axis.label));
  check_labels(axis, items);
  return axis;
}

void read_axes(MapReader& map, Study& study) {
  const Node* node = map.find("axes");
  if (!node) return;
  std::size_t runs = 1;
  for (const NodePtr& item : read_list(*node, "axes")) {
    study.axes.push_back(read_axis(*item));
    const std::string& name = study.axes.back().name;
    for (std::size_t a = 0; a + 1 < study.axes.size(); ++a)
      if (study.axes[a].name == name) fail_at(item->where, fmt::format("a second axis named '{}'", name));
    runs *= study.axes.back().values.size();
    if (runs > max_runs) fail_at(item->where, fmt::format("the axes make more than {} runs", max_runs));
  }
}

Measures read_measures(MapReader& study) {
  MapReader map = study.map("measure", keys::measure);
  Measures measures;
  measures.render = map.boolean("render", measures.render);
  measures.measured = map.boolean("measured", measures.measured);
  measures.repeats = map.integer("repeats", measures.repeats);
  if (map.find("error")) {
    MapReader error = map.map("error", keys::error);
    measures.error.until = error.number("until");
    measures.error.changes = read_changes(error.require("set"));
    measures.error.where = error.where("set");
  }
  return measures;
}

int axis_index(const Study& study, const Node& node, std::string_view key) {
  const std::string name = read_text(node, key);
  std::vector<std::string_view> names;
  for (const Axis& axis : study.axes) names.push_back(axis.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    fail_at(node.where, fmt::format("there is no axis '{}'{}", name, suggestion(name, names, "axes are")));
  return static_cast<int>(found - names.begin());
}

int value_index(const Axis& axis, const Node& node) {
  const std::string label = read_text(node, "a label");
  std::vector<std::string_view> labels;
  for (const AxisValue& value : axis.values) labels.push_back(value.label);
  const auto found = std::find(labels.begin(), labels.end(), label);
  if (found == labels.end())
    fail_at(node.where,
            fmt::format("the axis '{}' has no value '{}'{}", axis.name, label, suggestion(label, labels, "it has")));
  return static_cast<int>(found - labels.begin());
}

// {axis: label} or {axis: [label, label]}.
std::vector<Selection> read_where(const Study& study, MapReader& map) {
  std::vector<Selection> selections;
  const Node* node = map.find("where");
  if (!node) return selections;
  if (node->kind != Node::Kind::map) fail_at(node->where, "where must be a map like {AXIS: LABEL}");
  for (const Entry& entry : node->entries) {
    const NodePtr name = make_scalar(entry.key);
    name->where = entry.where;
    Selection selection{axis_index(study, *name, "axis"), {}};
    const Axis& axis = study.axes[selection.axis];
    if (entry.value->kind == Node::Kind::list)
      for (const NodePtr& item : entry.value->items) selection.values.push_back(value_index(axis, *item));
    else
      selection.values.push_back(value_index(axis, *entry.value));
    selections.push_back(std::move(selection));
  }
  return selections;
}

std::vector<int> read_axis_list(const Study& study, MapReader& map, std::string_view key) {
  std::vector<int> axes;
  if (const Node* node = map.find(key))
    for (const NodePtr& item : read_list(*node, key)) axes.push_back(axis_index(study, *item, key));
  return axes;
}

void read_times(MapReader& map, bool required, PictureSpec& picture) {
  const Node* node = required ? &map.require("times") : map.find("times");
  if (!node) return;
  for (const NodePtr& item : read_list(*node, "times")) {
    picture.times.push_back(read_number(*item, "a time", map.key("times").range));
    picture.times_where.push_back(item->where);
  }
  if (picture.times.empty() && required) fail_at(node->where, "times is empty");
}

std::vector<std::string> read_views(MapReader& map) {
  std::vector<std::string> views;
  const Node* node = map.find("views");
  if (!node) return {"textured"};
  for (const NodePtr& item : read_list(*node, "views")) {
    views.push_back(read_word(*item, "view", map.key("views").choices));
  }
  if (views.empty()) fail_at(node->where, "views is empty");
  return views;
}

// What no run would have, found before all of them are done.
void check_is_measured(const Measures& measures, const ResultColumn& column, const std::string& where) {
  const auto lacks = [&](bool there, std::string_view key) {
    if (!there)
      fail_at(where, fmt::format("'{}' is not measured; add 'measure: {{{}}}' to the study", column.name, key));
  };
  if (column.name.starts_with("measured")) lacks(measures.measured, "measured: true");
  if (column.group == ColumnGroup::cost) lacks(measures.repeats > 0, "repeats: 1");
  if (column.group == ColumnGroup::error) lacks(measures.error.until > 0.0, "error: {until: …, set: {…}}");
}

std::string read_column(const Study& study, const Node& node, std::string_view key) {
  const std::string name = read_text(node, key);
  std::vector<std::string_view> known;
  for (const ResultColumn& column : result_columns()) known.push_back(column.name);
  for (const Axis& axis : study.axes) known.push_back(axis.name);
  if (std::find(known.begin(), known.end(), name) == known.end())
    fail_at(node.where, fmt::format("there is no column '{}'{}", name, suggestion(name, known, "columns are")));
  const bool is_axis =
      std::any_of(study.axes.begin(), study.axes.end(), [&](const Axis& axis) { return axis.name == name; });
  if (const ResultColumn* column = find_column(name); column && !is_axis)
    check_is_measured(study.measures, *column, node.where);
  return name;
}

void read_log(MapReader& map, PictureSpec& picture) {
  const Node* node = map.find("log");
  if (!node) return;
  for (const NodePtr& item : read_list(*node, "log"))
    (read_word(*item, "log", map.key("log").choices) == "x" ? picture.log_x : picture.log_y) = true;
}

void read_labels(const Study& study, MapReader& map, PictureSpec& picture) {
  picture.by = read_axis_list(study, map, "by");
  picture.x_label = map.text("x_label", "");
  picture.y_label = map.text("y_label", "");
  read_log(map, picture);
}

void read_plot(const Study& study, MapReader& map, PictureSpec& picture) {
  picture.x = read_column(study, map.require("x"), "x");
  const Node& y = map.require("y");
  if (y.kind == Node::Kind::list)
    for (const NodePtr& item : y.items) picture.y.push_back(read_column(study, *item, "y"));
  else
    picture.y.push_back(read_column(study, y, "y"));
  if (picture.y.empty()) fail_at(y.where, "y is empty");
  read_labels(study, map, picture);
}

void read_kind(const Study& study, MapReader& map, PictureSpec& picture) {
  switch (picture.kind) {
    case PictureKind::strips:
    case PictureKind::frames:
      if (const Node* rows = map.find("rows")) picture.rows = axis_index(study, *rows, "rows");
      read_times(map, picture.kind == PictureKind::frames, picture);
      picture.views = read_views(map);
      break;
    case PictureKind::spectra:
      if (const Node* columns = map.find("columns")) picture.rows = axis_index(study, *columns, "columns");
      break;
    case PictureKind::plot:
      return read_plot(study, map, picture);
    case PictureKind::spectrum_curves:
      return read_labels(study, map, picture);
  }
}

PictureSpec read_picture(const Study& study, const Node& node) {
  const Entry* kind = node.find("kind");
  if (!kind) fail_at(node.where, "a picture needs the key 'kind'");
  PictureSpec picture;
  picture.kind = read_choice<PictureKind>(*kind->value, "kind");
  MapReader map(node, keys::picture(picture.kind), make_map());
  picture.name = map.text("name");
  picture.place = node.where;
  if (!is_file_name(picture.name)) fail_at(map.where("name"), "a picture's name is letters, digits, _ and - only");
  picture.title = map.text("title", "");
  picture.note = map.text("note", "");
  picture.where = read_where(study, map);
  read_kind(study, map, picture);
  if (picture.kind != PictureKind::plot && !study.measures.render)
    fail_at(kind->value->where,
            fmt::format("a picture of {} needs rendered runs; set measure.render to true", kind->value->text));
  return picture;
}

/// Whose a file of the study's folder is; `where` is empty for the study's own.
struct FileOwner {
  std::string name, where;
};
using FileOwners = std::map<std::string, FileOwner>;  // by the file's name in lower case

// Every file of the study's folder has one writer.
void check_file_names(const PictureSpec& picture, const std::string& where, FileOwners& owners) {
  for (const std::string& file : files_of(picture)) {
    const auto [owner, fresh] = owners.try_emplace(lower_case(file), FileOwner{picture.name, where});
    const auto& [name, first] = owner->second;
    if (fresh) continue;
    if (first.empty())
      fail_at(where, fmt::format("a picture named '{}' would replace the study's own {}; call it differently",
                                 picture.name, name));
    fail_at(where,
            fmt::format("a second picture named '{}'; the first is at {}{}", picture.name, first,
                        name == picture.name ? "" : fmt::format("; some file systems take '{}' for the same", name)));
  }
}

void read_pictures(MapReader& map, Study& study) {
  FileOwners owners;
  for (const std::string_view file : {study_files::table, study_files::record, study_files::page})
    owners[std::string(file)] = {std::string(file), ""};
  for (const NodePtr& item : read_list(map.require("pictures"), "pictures")) {
    study.pictures.push_back(read_picture(study, *item));
    check_file_names(study.pictures.back(), item->find("name")->value->where, owners);
  }
  if (study.pictures.empty()) fail_at(map.where("pictures"), "pictures is empty: a study needs something to make");
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
  const NodePtr root = read_yaml_file(file);
  MapReader map(*root, keys::study, make_map());
  read_version(map);
  Study study;
  study.file = file;
  study.title = map.text("title", file.stem().string());
  study.about = map.text("about", "");
  study.scene = read_scene_path(map, file.parent_path());
  if (const Node* set = map.find("set")) study.base = read_changes(*set);
  read_axes(map, study);
  study.measures = read_measures(map);
  read_pictures(map, study);
  return study;
}

}  // namespace billow::cli
