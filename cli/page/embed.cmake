# Writes OUTPUT, a C++ file that holds FILES (a comma-separated list) as text: see cli/page/page_file.h.
string(REPLACE "," ";" files "${FILES}")
set(entries "")
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND entries "    {\"${name}\", R\"billow_page(${text})billow_page\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made from cli/page by cli/page/embed.cmake; change the files there.
#include \"cli/page/page_file.h\"

#include <map>
#include <stdexcept>
#include <string>

namespace billow::cli {

std::string_view page_file(std::string_view name) {
  static const std::map<std::string_view, std::string_view> files{
${entries}  };
  const auto found = files.find(name);
  if (found == files.end()) throw std::logic_error(\"cli/page has no \" + std::string(name));
  return found->second;
}

}  // namespace billow::cli
")
