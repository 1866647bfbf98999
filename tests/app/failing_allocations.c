/* Loaded before libc (LD_PRELOAD), this lets one allocation of at least $GRACILIS_FAULT_BYTES within main() fail as if no
   memory were left: the one whose number is $GRACILIS_FAULT_AT, counted from 1. How many there were is left in
   $GRACILIS_FAULT_COUNT. C++'s `new` asks malloc, so that it is covered, too. Before main() libraries set themselves up;
   some abort there, and nobody could tell them not to. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);
extern void* __libc_memalign(size_t alignment, size_t size);

static atomic_long allocations;
static atomic_int in_main;

static size_t number_in(const char* name) {
  const char* text = getenv(name);
  return text ? (size_t)atol(text) : 0;
}

/* Whether this allocation is the one. */
static int fails(size_t size) {
  if (!atomic_load(&in_main) || size < number_in("GRACILIS_FAULT_BYTES")) return 0;
  if ((size_t)atomic_fetch_add(&allocations, 1) + 1 != number_in("GRACILIS_FAULT_AT")) return 0;
  errno = ENOMEM;
  return 1;
}

__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("GRACILIS_FAULT_COUNT");
  FILE* file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", atomic_load(&allocations));
  fclose(file);
}

void* malloc(size_t size) { return fails(size) ? NULL : __libc_malloc(size); }

void* calloc(size_t count, size_t size) {
  return fails(count * size) ? NULL : __libc_calloc(count, size);  /* libc checks the product itself */
}

void* realloc(void* old, size_t size) { return fails(size) ? NULL : __libc_realloc(old, size); }

void* memalign(size_t alignment, size_t size) { return fails(size) ? NULL : __libc_memalign(alignment, size); }

void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }

int posix_memalign(void** result, size_t alignment, size_t size) {
  void* memory = memalign(alignment, size);
  if (!memory) return ENOMEM;
  *result = memory;
  return 0;
}

typedef int (*Main)(int count, char** words, char** environment);
static Main real_main;

static int watched_main(int count, char** words, char** environment) {
  atomic_store(&in_main, 1);
  const int code = real_main(count, words, environment);
  atomic_store(&in_main, 0);
  return code;
}

/* What calls main() once all is set up. */
int __libc_start_main(Main main, int count, char** words, void (*init)(void), void (*fini)(void),
                      void (*end_of_loader)(void), void* end_of_stack) {
  real_main = main;
  __typeof__(&__libc_start_main) start = (__typeof__(&__libc_start_main))dlsym(RTLD_NEXT, "__libc_start_main");
  return start(watched_main, count, words, init, fini, end_of_loader, end_of_stack);
}
