# Writes OUTPUT, a C++ file that holds the commit that SOURCE has checked out, by the program GIT, with "-dirty" behind it
# where what the tool is built of differs from it; "" where SOURCE is empty or no checkout of its own. GIVEN, where it is
# not empty, stands in its place.
set(commit "${GIVEN}")
if(SOURCE AND NOT GIVEN)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel HEAD
                  OUTPUT_VARIABLE answer OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0 AND answer MATCHES "^(.*)\n([0-9a-f]+)$")
    file(REAL_PATH "${CMAKE_MATCH_1}" top)
    set(found ${CMAKE_MATCH_2})
    file(REAL_PATH "${SOURCE}" source)
    if(top STREQUAL source)  # and not within another project's
      execute_process(COMMAND ${GIT} --no-optional-locks -C ${SOURCE} status --porcelain --
                              CMakeLists.txt base sim render cli packaging
                      OUTPUT_VARIABLE changes ERROR_QUIET)
      set(commit ${found})
      if(NOT changes STREQUAL "")
        string(APPEND commit "-dirty")
      endif()
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "// Made by cli/command/commit.cmake.
extern const char* const billow_commit;
const char* const billow_commit = \"${commit}\";
")
file(TOUCH_NOCREATE "${OUTPUT}")  # newer than what it depends on, changed or not
