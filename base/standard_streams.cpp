// open() gives the lowest number that is free.
#include "base/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

namespace billow {

void open_standard_streams() {
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(standard, F_GETFD) < 0) open("/dev/null", standard == STDOUT_FILENO ? O_RDONLY : O_RDWR);
}

}  // namespace billow
