// The billow command-line tool.
#include "cli/command/application.h"

extern const char* const billow_commit;  // commit.cmake

int main(int argc, char** argv) { return billow::cli::run(argc, argv, billow_commit); }
