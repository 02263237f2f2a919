// A study's results as a page.
#include "cli/study/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/xml.h"
#include "cli/page/report_page.h"
#include "cli/text/command_text.h"

namespace billow::cli {

namespace {

namespace fs = std::filesystem;

// Plots as SVG, which stays sharp in print; their data beside them.
std::string figure(const PictureSpec& picture, bool first) {
  const std::string title = xml_escape(picture.title.empty() ? picture.name : picture.title);
  const std::string file = picture.name + (is_plot(picture) ? ".svg" : ".png");
  const std::string data = is_plot(picture) ? fmt::format(R"( <a href="{0}.csv">{0}.csv</a>)", picture.name) : "";
  return fmt::format(
      R"({}<figure class="hero"><a href="{}"><img src="{}" alt="{}"></a><figcaption>{}{}</figcaption></figure>
)",
      first ? "" : "<h2>" + title + "</h2>\n", file, file, title, xml_escape(picture.note), data);
}

// The columns that any run has a value in.
std::vector<const ResultColumn*> used_columns(const StudyContents& contents) {
  std::vector<const ResultColumn*> used;
  for (const ResultColumn& column : result_columns())
    if (std::any_of(contents.results.begin(), contents.results.end(),
                    [&](const RunResult& result) { return result.value(column.name).has_value(); }))
      used.push_back(&column);
  return used;
}

std::string head(const StudyContents& contents, const std::vector<const ResultColumn*>& columns) {
  std::string row = R"(<tr><th class="number">run</th>)";
  for (const Axis& axis : contents.study.axes) row += "<th>" + xml_escape(axis.name) + "</th>";
  row += "<th>status</th>";
  for (const ResultColumn* column : columns) {
    const std::string unit = column->unit.empty() ? "" : fmt::format(" [{}]", column->unit);
    row += fmt::format(R"(<th class="number">{}{}</th>)", xml_escape(column->name), xml_escape(unit));
  }
  return row + "</tr>\n";
}

// A run that was rendered has a page of its own.
std::string numbered(const StudyContents& contents, const StudyRun& run) {
  const fs::path page = run_folder("", contents.study, run) / "film" / "index.html";
  std::error_code error;
  if (!fs::exists(contents.folder / page, error)) return std::to_string(run.number);
  return fmt::format(R"(<a href="{}">{}</a>)", xml_escape(page.generic_string()), run.number);
}

std::string row(const StudyContents& contents, std::size_t r, const std::vector<const ResultColumn*>& columns) {
  const StudyRun& run = contents.runs[r];
  const RunResult& result = contents.results[r];
  std::string out = fmt::format(R"(<tr{}><td class="number">{}</td>)",
                                result.status == RunStatus::done ? "" : R"( class="bad")", numbered(contents, run));
  for (std::size_t a = 0; a < contents.study.axes.size(); ++a)
    out += "<td>" + xml_escape(contents.study.axes[a].values[run.choice[a]].label) + "</td>";
  const std::string why = result.message.empty() ? "" : fmt::format(R"( title="{}")", xml_escape(result.message));
  out += fmt::format("<td{}>{}</td>", why, name(result.status));
  for (const ResultColumn* column : columns) {
    const std::optional<double> value = result.value(column->name);
    out += fmt::format(R"(<td class="number">{}</td>)", value ? fmt::format("{:.4g}", *value) : "");
  }
  return out + "</tr>\n";
}

std::string runs_table(const StudyContents& contents) {
  const std::vector<const ResultColumn*> columns = used_columns(contents);
  std::string out = "<h2>Runs</h2>\n<div class=\"scroll\"><table class=\"runs\"><thead>\n" + head(contents, columns) +
                    "</thead><tbody>\n";
  for (std::size_t r = 0; r < contents.runs.size(); ++r) out += row(contents, r, columns);
  return out +
         "</tbody></table></div>\n<p><a href=\"results.csv\">results.csv</a>, "
         "<a href=\"study.json\">study.json</a></p>\n";
}

std::string commands(const StudyContents& contents) {
  std::string out = "<h2>Again</h2>\n<pre class=\"command\">" +
                    xml_escape(command_line({"billow", "study", contents.study.file.string()})) +
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

// Runs without a result come first: a reader must not take the pictures for complete.
std::string shortfalls(const StudyContents& contents) {
  std::string out;
  for (const RunStatus status : {RunStatus::missing, RunStatus::failed, RunStatus::diverged}) {
    const auto runs = std::count_if(contents.results.begin(), contents.results.end(),
                                    [&](const RunResult& result) { return result.status == status; });
    if (runs > 0)
      out +=
          fmt::format("<p class=\"note {}\">{} of {} runs {} {}.</p>\n", status == RunStatus::diverged ? "warn" : "bad",
                      runs, contents.runs.size(), status == RunStatus::missing ? (runs == 1 ? "is" : "are") : "",
                      status == RunStatus::missing ? "missing" : std::string(name(status)));
  }
  return out;
}

}  // namespace

std::string study_page(const StudyContents& contents) {
  const Study& study = contents.study;
  std::string body = fmt::format("<header><h1>{}</h1>\n<p class=\"summary\">{}</p></header>\n", xml_escape(study.title),
                                 xml_escape(study.about));
  body += shortfalls(contents);
  for (std::size_t p = 0; p < study.pictures.size(); ++p) {
    const auto fault = contents.faults.find(study.pictures[p].name);
    body += fault == contents.faults.end() ? figure(study.pictures[p], p == 0)
                                           : fmt::format("<p class=\"note bad\">{}: {}</p>\n", xml_escape(fault->first),
                                                         xml_escape(fault->second));
  }
  body += runs_table(contents) + commands(contents);
  return html_page(study.title, body);
}

}  // namespace billow::cli
