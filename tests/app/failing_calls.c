/* Loaded before libc (LD_PRELOAD), this lets one call that writes below $GRACILIS_FAULT_FOLDER fail as on a full disk:
   the one whose number is $GRACILIS_FAULT_AT, counted from 1. How many there were is left in $GRACILIS_FAULT_COUNT. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;

static int is_below(const char* path) {
  const char* folder = getenv("GRACILIS_FAULT_FOLDER");
  return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_file_below(int file) {
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return 0;
  path[length] = 0;
  return is_below(path);
}

/* Whether this call is the one. */
static int fails(void) {
  const char* at = getenv("GRACILIS_FAULT_AT");
  if (atomic_fetch_add(&calls, 1) + 1 != (at ? atol(at) : 0)) return 0;
  errno = ENOSPC;
  return 1;
}

__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("GRACILIS_FAULT_COUNT");
  FILE* file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", atomic_load(&calls));
  fclose(file);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int file, const void* bytes, size_t size) {
  if (is_file_below(file) && fails()) return -1;
  return REAL(write)(file, bytes, size);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  if (is_file_below(file) && fails()) return -1;
  return REAL(pwrite)(file, bytes, size, at);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  if (is_file_below(file) && fails()) return -1;
  return REAL(writev)(file, parts, count);
}

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_CREAT) && is_below(path) && fails()) return -1;
  return REAL(open)(path, flags, mode);
}

int rename(const char* from, const char* to) {
  if (is_below(to) && fails()) return -1;
  return REAL(rename)(from, to);
}

int fsync(int file) {
  if (is_file_below(file) && fails()) return -1;
  return REAL(fsync)(file);
}

int mkdir(const char* path, mode_t mode) {
  if (is_below(path) && fails()) return -1;
  return REAL(mkdir)(path, mode);
}

int ftruncate(int file, off_t size) {
  if (is_file_below(file) && fails()) return -1;
  return REAL(ftruncate)(file, size);
}
