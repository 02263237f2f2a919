// malloc and its kin in the place of the C library's, which the dynamic linker then gives to every library; they are
// the C library's own but for what happens when they fail.
#include "base/out_of_memory.h"

#include <unistd.h>

#include <atomic>
#include <cstring>

#include "base/sudden_end.h"

#if defined(__GLIBC__) && !defined(BILLOW_SANITIZE)
#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>

#include <cerrno>
#endif

namespace billow {

namespace {

constexpr int exit_internal_fault = 1;

void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody can be told
}

void end_process(const char* missing, std::size_t) {
  tidy_up(SuddenEnd::failure);
  say(missing);
  say("\n");
  _exit(exit_internal_fault);
}

// Set before any code runs, constructors of libraries included.
constinit std::atomic<OutOfMemoryAction> current_action = end_process;

}  // namespace

void set_out_of_memory_action(OutOfMemoryAction action) { current_action = action; }

#if defined(__GLIBC__) && !defined(BILLOW_SANITIZE)

namespace {

void report(const char* missing, std::size_t bytes) {
  const int error = errno;
  current_action.load()(missing, bytes);
  errno = error;
}

void* checked(void* memory, std::size_t size) {
  if (!memory && size > 0) report("out of memory", size);
  return memory;
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) noexcept { return checked(__libc_malloc(size), size); }

void* calloc(std::size_t count, std::size_t size) noexcept {
  return checked(__libc_calloc(count, size), count == 0 ? 0 : size);
}

void* realloc(void* memory, std::size_t size) noexcept { return checked(__libc_realloc(memory, size), size); }

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return checked(__libc_memalign(alignment, size), size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }

int posix_memalign(void** result, std::size_t alignment, std::size_t size) noexcept {
  if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0) return EINVAL;
  void* const memory = memalign(alignment, size);
  if (!memory && size > 0) return ENOMEM;
  *result = memory;
  return 0;
}

// What programs that are compiled at run time ask for, the renderer's among them.
void* mmap(void* address, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  void* const memory = reinterpret_cast<void*>(syscall(SYS_mmap, address, size, protection, flags, file, offset));
  if (memory == MAP_FAILED && errno == ENOMEM) report("out of memory", size);
  return memory;
}

void* mmap64(void* address, std::size_t size, int protection, int flags, int file, off64_t offset) noexcept {
  return mmap(address, size, protection, flags, file, offset);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  const int error = create(thread, attributes, work, argument);
  if (error == EAGAIN || error == ENOMEM) report("no thread can be started: out of memory, or too many of them", 0);
  return error;
}
}

#endif

}  // namespace billow
