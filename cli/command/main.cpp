// The billow command-line tool.
#include "cli/command/application.h"

int main(int argc, char** argv) { return billow::cli::run(argc, argv); }
