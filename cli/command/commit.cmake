# Writes OUTPUT, a C++ file that holds the commit that SOURCE has checked out, by the program GIT; "" where SOURCE is
# empty or no checkout of its own.
set(commit "")
if(SOURCE)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel HEAD
                  OUTPUT_VARIABLE answer OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0 AND answer MATCHES "^(.*)\n([0-9a-f]+)$")
    file(REAL_PATH "${CMAKE_MATCH_1}" top)
    set(found ${CMAKE_MATCH_2})
    file(REAL_PATH "${SOURCE}" source)
    if(top STREQUAL source)  # and not within another project's
      set(commit ${found})
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "// Made by cli/command/commit.cmake.
extern const char* const billow_commit;
const char* const billow_commit = \"${commit}\";
")
