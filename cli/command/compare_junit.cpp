// Pairs -> test cases.
#include <fmt/format.h>

#include <algorithm>

#include "base/atomic_file.h"
#include "base/xml.h"
#include "cli/command/compare_report.h"

namespace billow::cli {

namespace {

std::string case_of(const ComparedPair& pair, const std::string& suite) {
  const std::string head =
      fmt::format("  <testcase classname=\"{}\" name=\"{}\"", xml_escape(suite), xml_escape(pair.name));
  if (pair.verdict == Verdict::same) return head + "/>\n";
  const char* kind = pair.verdict == Verdict::different ? "failure" : "error";
  return fmt::format("{}>\n    <{} message=\"{}\"/>\n  </testcase>\n", head, kind, xml_escape(pair.why));
}

}  // namespace

void write_junit(const std::filesystem::path& file, const std::vector<ComparedPair>& pairs, const std::string& suite) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(pairs.begin(), pairs.end(), [&](const ComparedPair& pair) { return pair.verdict == verdict; });
  };
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\">\n",
      xml_escape(suite), pairs.size(), count(Verdict::different), count(Verdict::unreadable));
  for (const ComparedPair& pair : pairs) xml += case_of(pair, suite);
  write_file_atomically(file, xml + "</testsuite>\n");
}

}  // namespace billow::cli
