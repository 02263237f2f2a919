// A study's results as a page.
#include "cli/study/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "base/error.h"
#include "base/readable_number.h"
#include "base/utf8.h"
#include "base/xml.h"
#include "cli/page/report_page.h"
#include "cli/study/study_plan.h"
#include "cli/text/command_text.h"
#include "render/image/png.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

constexpr double tall = 2.4;             // times as high as wide: more than a printed page shows at once
constexpr std::size_t most_columns = 7;  // of values, that fit on a printed page

// Files to take away: the pictures that the page shows, the others, and a plot's numbers.
std::string links_to(const PictureSpec& picture) {
  std::string links;
  for (const std::string& file : files_of(picture))
    links += fmt::format(R"({}<a href="{}">{}</a>)", links.empty() ? "" : ", ", file, file);
  return links;
}

/// What the page tells a browser of a picture.
struct PictureSize {
  std::string attributes;
  bool tall = false;
};

// A sheet may be larger than what is read back; the browser finds its size then.
PictureSize size_of_picture(const fs::path& png) {
  try {
    const render::PngRows rows(png);
    return {fmt::format(R"( width="{}" height="{}")", rows.width(), rows.height()),
            rows.height() > tall * rows.width()};
  } catch (const InputError&) {
    return {"", true};
  }
}

// Title and note are in the picture, so the page says them only to those who do not see it. Plots as SVG, which stays
// sharp in print.
std::string figure(const StudyContents& contents, const PictureSpec& picture) {
  const PictureSize size = size_of_picture(contents.folder / (picture.name + ".png"));
  const std::string title = picture.title.empty() ? picture.name : picture.title;
  const std::string shown = picture.name + (is_plot(picture) ? ".svg" : ".png");
  return fmt::format(
      R"(<figure class="study{}"><a href="{}"><img src="{}"{} alt="{}"></a><figcaption>{}</figcaption></figure>
)",
      size.tall ? " tall" : "", shown, shown, size.attributes,
      xml_escape(picture.note.empty() ? title : title + ". " + picture.note), links_to(picture));
}

using Columns = std::vector<const ResultColumn*>;

bool has_values(const StudyContents& contents, const ResultColumn& column) {
  return std::any_of(contents.results.begin(), contents.results.end(),
                     [&](const RunResult& result) { return result.value(column.name).has_value(); });
}

// Whether all of several runs have the same value.
bool is_common(const StudyContents& contents, const ResultColumn& column) {
  const std::optional<double> first = contents.results.front().value(column.name);
  return contents.results.size() > 1 && first &&
         std::all_of(contents.results.begin(), contents.results.end(),
                     [&](const RunResult& result) { return result.value(column.name) == first; });
}

Columns columns_where(const StudyContents& contents, bool common) {
  Columns columns;
  for (const ResultColumn& column : result_columns())
    if (has_values(contents, column) && is_common(contents, column) == common) columns.push_back(&column);
  return columns;
}

std::string with_unit_of(const ResultColumn& column, const std::string& text) {
  return text + (column.unit.empty() ? "" : " " + std::string(column.unit));
}

std::string common_values(const StudyContents& contents) {
  std::vector<std::string> values;
  for (const ResultColumn* column : columns_where(contents, true))
    values.push_back(fmt::format("{} {}", column->name,
                                 with_unit_of(*column, readable(*contents.results.front().value(column->name)))));
  return values.empty() ? ""
                        : fmt::format("<p>All runs: {}.</p>\n", xml_escape(fmt::format("{}", fmt::join(values, ", "))));
}

// Characters of the longest word, up to as many as a column should be wide to hold it whole.
int word_width(const std::string& text) {
  constexpr int widest = 18;
  int longest = 0, word = 0;
  for (const char c : text) {
    word = c == ' ' ? 0 : word + (is_continuation(c) ? 0 : 1);
    longest = std::max(longest, word);
  }
  return std::min(longest, widest);
}

// Wide enough for the words of its labels; only longer ones are broken.
std::string axis_head(const Axis& axis) {
  int width = word_width(axis.label);
  for (const AxisValue& value : axis.values) width = std::max(width, word_width(value.label));
  return fmt::format(R"(<th class="label" style="min-width: {}ch">{}</th>)", width + 1, xml_escape(axis.label));
}

// "certified_ratio" may be broken behind its underscores.
std::string column_head(const ResultColumn& column) {
  std::string name;
  for (const char c : xml_escape(column.name)) name += c == '_' ? "_<wbr>" : std::string(1, c);
  return fmt::format(R"(<th class="number">{}{}</th>)", name,
                     column.unit.empty() ? "" : fmt::format(" [{}]", xml_escape(column.unit)));
}

std::string head(const StudyContents& contents, const Columns& columns, bool with_status) {
  std::string row = R"(<tr><th class="number">run</th>)";
  for (const Axis& axis : contents.study.axes) row += axis_head(axis);
  if (with_status) row += "<th>status</th>";
  for (const ResultColumn* column : columns) row += column_head(*column);
  return row + "</tr>\n";
}

// Decimals of "1,024.50"; none where a power of ten follows.
std::size_t decimals_of(const std::string& number) {
  const std::size_t point = number.find('.');
  return point == std::string::npos || number.find("×") != std::string::npos ? 0 : number.size() - point - 1;
}

std::size_t most_decimals(const StudyContents& contents, const ResultColumn& column) {
  std::size_t most = 0;
  for (const RunResult& result : contents.results)
    if (const std::optional<double> value = result.value(column.name))
      most = std::max(most, decimals_of(readable(*value)));
  return most;
}

// With blanks as wide as the point and the digits that others of its column have: points stand below one another.
std::string lined_up(std::string number, std::size_t most) {
  const std::size_t decimals = decimals_of(number);
  if (number.find("×") != std::string::npos) return number;
  if (decimals == 0 && most > 0) number += "\u2008";
  for (std::size_t k = decimals; k < most; ++k) number += "\u2007";
  return number;
}

// A run that was rendered has a page of its own.
std::string numbered(const StudyContents& contents, const StudyRun& run) {
  const fs::path page = run_folder("", contents.study, run) / "film" / "index.html";
  std::error_code error;
  if (!fs::exists(contents.folder / page, error)) return std::to_string(run.number);
  return fmt::format(R"(<a href="{}">{}</a>)", xml_escape(page.generic_string()), run.number);
}

std::string row(const StudyContents& contents, std::size_t r, const Columns& columns, bool with_status) {
  const StudyRun& run = contents.runs[r];
  const RunResult& result = contents.results[r];
  std::string out = fmt::format(R"(<tr{}><td class="number">{}</td>)",
                                result.status == RunStatus::done ? "" : R"( class="bad")", numbered(contents, run));
  for (std::size_t a = 0; a < contents.study.axes.size(); ++a)
    out += R"(<td class="label">)" + xml_escape(contents.study.axes[a].values[run.choice[a]].label) + "</td>";
  if (with_status) out += fmt::format("<td>{}</td>", name(result.status));
  for (const ResultColumn* column : columns) {
    const std::optional<double> value = result.value(column->name);
    out += fmt::format(R"(<td class="number">{}</td>)",
                       value ? lined_up(readable(*value), most_decimals(contents, *column)) : "");
  }
  return out + "</tr>\n";
}

std::string table(const StudyContents& contents, const Columns& columns, bool with_status) {
  std::string out = "<div class=\"scroll\"><table class=\"runs\"><thead>\n" + head(contents, columns, with_status) +
                    "</thead><tbody>\n";
  for (std::size_t r = 0; r < contents.runs.size(); ++r) out += row(contents, r, columns, with_status);
  return out + "</tbody></table></div>\n";
}

std::string_view title_of(ColumnGroup group) {
  switch (group) {
    case ColumnGroup::scene:
      return "Scenes";
    case ColumnGroup::steps:
      return "Steps";
    case ColumnGroup::ratios:
      return "Steps as multiples of the unfiltered limit";
    case ColumnGroup::cost:
      return "Cost";
    case ColumnGroup::error:
      return "Distance from the reference";
  }
  throw std::logic_error("a group of columns has no title");
}

// One table, or one for each group of columns where they would be too many to stand beside each other, also on paper.
std::string tables(const StudyContents& contents) {
  const Columns all = columns_where(contents, false);
  if (all.size() <= most_columns) return table(contents, all, true);
  std::string out;
  for (const ColumnGroup group :
       {ColumnGroup::scene, ColumnGroup::steps, ColumnGroup::ratios, ColumnGroup::cost, ColumnGroup::error}) {
    Columns columns;
    for (const ResultColumn* column : all)
      if (column->group == group) columns.push_back(column);
    if (!columns.empty()) out += fmt::format("<h3>{}</h3>\n", title_of(group)) + table(contents, columns, out.empty());
  }
  return out;
}

std::string results(const StudyContents& contents) {
  return "<h2>Runs</h2>\n" + common_values(contents) + tables(contents) +
         "<p><a href=\"results.csv\">results.csv</a>, <a href=\"study.json\">study.json</a></p>\n";
}

// Into the folder that the page is in.
std::string command_again(const StudyContents& contents) {
  std::vector<std::string> words{"billow", "study", contents.study.file.string()};
  if (contents.folder != usual_folder(contents.study.file)) words.insert(words.end(), {"-o", contents.folder.string()});
  return command_line(words);
}

std::string commands(const StudyContents& contents) {
  std::string out = "<h2>Again</h2>\n<pre class=\"command\">" + xml_escape(command_again(contents)) +
                    "</pre>\n<details><summary>The command for each run, and its whole scene</summary>\n";
  for (std::size_t r = 0; r < contents.runs.size(); ++r) {
    const RunResult& result = contents.results[r];
    if (result.status == RunStatus::missing) continue;
    out += fmt::format("<h3>{}: {}</h3>\n<pre class=\"command\">{}</pre>\n", contents.runs[r].number,
                       xml_escape(label_of(contents.study, contents.runs[r])), xml_escape(result.command));
    if (!result.message.empty()) out += fmt::format("<p class=\"note bad\">{}</p>\n", xml_escape(result.message));
    if (!result.scene.empty())
      out += fmt::format("<details><summary>scene</summary><pre class=\"scene\">{}</pre></details>\n",
                         xml_escape(result.scene));
  }
  return out + "</details>\n";
}

// "2 of 9 runs diverged:", and below it why, run by run, the first few of them.
std::string shortfall(const StudyContents& contents, RunStatus status) {
  constexpr int most_explained = 3;
  int runs = 0;
  std::string why;
  for (std::size_t r = 0; r < contents.runs.size(); ++r) {
    const RunResult& result = contents.results[r];
    if (result.status != status || ++runs > most_explained || result.message.empty()) continue;
    why += fmt::format("\nrun {}, {}: {}", contents.runs[r].number, label_of(contents.study, contents.runs[r]),
                       result.message);
  }
  if (runs == 0) return "";
  if (runs > most_explained && !why.empty()) why += fmt::format("\nand {} more: see the table", runs - most_explained);
  const std::string what =
      status == RunStatus::missing ? (runs == 1 ? "is missing" : "are missing") : std::string(name(status));
  return fmt::format("<p class=\"note {}\">{} of {} runs {}{}{}</p>\n", status == RunStatus::diverged ? "warn" : "bad",
                     runs, contents.runs.size(), what, why.empty() ? "." : ":", xml_escape(why));
}

// Runs without a result come first: a reader must not take the pictures for complete.
std::string shortfalls(const StudyContents& contents) {
  std::string out;
  for (const RunStatus status : {RunStatus::missing, RunStatus::failed, RunStatus::diverged})
    out += shortfall(contents, status);
  return out;
}

}  // namespace

std::string study_page(const StudyContents& contents) {
  const Study& study = contents.study;
  std::string body = fmt::format("<header><h1>{}</h1>\n<p class=\"summary\">{}</p></header>\n", xml_escape(study.title),
                                 xml_escape(study.about));
  body += shortfalls(contents);
  for (const PictureSpec& picture : study.pictures) {
    const auto fault = contents.faults.find(picture.name);
    body += fault == contents.faults.end() ? figure(contents, picture)
                                           : fmt::format("<p class=\"note bad\">{}: {}</p>\n", xml_escape(fault->first),
                                                         xml_escape(fault->second));
  }
  body += results(contents) + commands(contents);
  return html_page(study.title, body);
}

}  // namespace billow::cli
