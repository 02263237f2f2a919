// A library to load before the tool's own: the N-th call of one function fails.
//
//   BILLOW_FAULT=KIND:N[:ERRNO]   the N-th call from 1 of that kind fails, and with N+ every later one; 0: none
//   BILLOW_FAULT_COUNT=FILE       the number of calls is written there at the end
//
// Kinds: alloc, mmap, thread, open (of a new file), write (stdio's and the system's), close, rename, mkdir, sync.
// Built by the drivers: g++ -shared -fPIC shim.cpp -o shim.so -ldl
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

struct Fault {
  char kind[16] = {};
  long number = 0;
  bool lasting = false;
  int error = EIO;
  const char* count_file = nullptr;
  std::atomic<long> calls = 0;
  pid_t process = 0;

  Fault() {
    process = getpid();
    count_file = std::getenv("BILLOW_FAULT_COUNT");
    const char* text = std::getenv("BILLOW_FAULT");
    if (!text) return;
    const char* colon = std::strchr(text, ':');
    if (!colon || colon - text >= static_cast<long>(sizeof kind)) return;
    std::memcpy(kind, text, static_cast<std::size_t>(colon - text));
    char* end = nullptr;
    number = std::strtol(colon + 1, &end, 10);
    lasting = *end == '+';
    if (const char* second = std::strchr(colon + 1, ':')) error = std::atoi(second + 1);
  }

  ~Fault() {
    if (!count_file || getpid() != process) return;
    char text[32];
    const int size = std::snprintf(text, sizeof text, "%ld\n", calls.load());
    const int file = next<int (*)(const char*, int, ...)>("open")(count_file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file >= 0) (void)!next<decltype(&::write)>("write")(file, text, static_cast<std::size_t>(size));
  }

  bool strikes(const char* what) {
    if (std::strcmp(kind, what) != 0) return false;
    const long call = ++calls;
    if (number <= 0 || (lasting ? call < number : call != number)) return false;
    errno = error;
    return true;
  }
};

Fault& fault() {
  static Fault one;
  return one;
}

}  // namespace

#define NEXT(name) static const auto real = next<decltype(&name)>(#name)

extern "C" {

void* __libc_malloc(std::size_t size) {
  NEXT(__libc_malloc);
  return fault().strikes("alloc") ? errno = ENOMEM, nullptr : real(size);
}
void* __libc_calloc(std::size_t count, std::size_t size) {
  NEXT(__libc_calloc);
  return fault().strikes("alloc") ? errno = ENOMEM, nullptr : real(count, size);
}
void* __libc_realloc(void* memory, std::size_t size) {
  NEXT(__libc_realloc);
  return fault().strikes("alloc") ? errno = ENOMEM, nullptr : real(memory, size);
}
void* __libc_memalign(std::size_t alignment, std::size_t size) {
  NEXT(__libc_memalign);
  return fault().strikes("alloc") ? errno = ENOMEM, nullptr : real(alignment, size);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument) {
  NEXT(pthread_create);
  return fault().strikes("thread") ? EAGAIN : real(thread, attributes, work, argument);
}

int open(const char* path, int flags, ...) {
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  va_list list;
  va_start(list, flags);
  const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) ? va_arg(list, mode_t) : 0;
  va_end(list);
  if ((flags & O_ACCMODE) != O_RDONLY && (flags & (O_CREAT | __O_TMPFILE)) && fault().strikes("open")) return -1;
  return real(path, flags, mode);
}

std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, std::FILE* stream) {
  NEXT(fwrite);
  return stream != stderr && stream != stdout && fault().strikes("write") ? 0 : real(bytes, size, count, stream);
}
int fflush(std::FILE* stream) {
  NEXT(fflush);
  return stream && stream != stderr && stream != stdout && fault().strikes("write") ? EOF : real(stream);
}
ssize_t write(int file, const void* bytes, std::size_t size) {
  NEXT(write);
  return file > STDERR_FILENO && fault().strikes("write") ? -1 : real(file, bytes, size);
}
int fclose(std::FILE* stream) {
  NEXT(fclose);
  const bool strikes = fault().strikes("close");
  const int error = errno, result = real(stream);
  return strikes ? errno = error, EOF : result;
}
int rename(const char* from, const char* to) {
  NEXT(rename);
  return fault().strikes("rename") ? -1 : real(from, to);
}
int mkdir(const char* path, mode_t mode) {
  NEXT(mkdir);
  return fault().strikes("mkdir") ? -1 : real(path, mode);
}
int fsync(int file) {
  NEXT(fsync);
  return fault().strikes("sync") ? -1 : real(file);
}
}
