// SPDX-License-Identifier: BSD-3-Clause
// Makes system calls of a program fail (LD_PRELOAD; scripts/fault_test.py, docs/trust.md).
//   FAULT_UNDER  absolute folder: only calls on it and on what lies below it are counted
//   FAULT_AT     KIND:N:WHAT: the N-th call (from 1) of KIND, or of "any" kind. WHAT is
//                EIO, EINTR   the call does nothing and fails, once
//                ENOSPC       this call and all later ones that need room fail
//                short        half of the bytes are written, or read
//                before       SIGKILL instead of the call
//                after        SIGKILL once the call is made
//                NULL         of KIND alloc: an allocation in main() of FAULT_SIZE bytes or more
//   FAULT_LOG    file that gets a line "KIND PATH" for each counted call, "fault PATH" at the fault,
//                and "allocations N" at the end of main()
// Without FAULT_AT nothing fails. glibc on Linux. What the C library calls itself (fwrite) is not
// seen; the writers of sslcd and SQLite make their calls themselves.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

static char under[PATH_MAX], at_kind[16], what[16];
static long at = 0, calls = 0, allocations = 0, least = 0;
static int log_file = -1, full = 0, in_main = 0;

__attribute__((constructor)) static void ReadSettings(void) {
  const char *folder = getenv("FAULT_UNDER"), *fault = getenv("FAULT_AT");
  const char *log = getenv("FAULT_LOG"), *size = getenv("FAULT_SIZE");
  if (fault != NULL && sscanf(fault, "%15[a-z]:%ld:%15s", at_kind, &at, what) != 3) abort();
  if (size != NULL) least = atol(size);
  if (log != NULL) log_file = open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (folder != NULL) snprintf(under, sizeof under, "%s", folder);  // counts from here on
}

static void Kill(void) { kill(getpid(), SIGKILL); }

static int IsUnder(const char *path) {
  char absolute[2 * PATH_MAX] = "";
  const size_t length = strlen(under);
  if (length == 0) return 0;
  if (path[0] != '/' && getcwd(absolute, PATH_MAX) != NULL) strcat(absolute, "/");
  strncat(absolute, path, PATH_MAX - 1);
  return strncmp(absolute, under, length) == 0 &&
         (absolute[length] == '/' || absolute[length] == '\0');
}

enum Answer { kPass, kFail, kShort, kDie };  // kFail: errno is set. kDie: after the call

static enum Answer Decide(const char *kind, const char *path, int needs_room) {
  if (!IsUnder(path)) return kPass;
  if (log_file >= 0) dprintf(log_file, "%s %s\n", kind, path);
  errno = ENOSPC;
  if (full && needs_room) return kFail;
  if (strcmp(at_kind, kind) != 0 && strcmp(at_kind, "any") != 0) return kPass;
  if (__atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST) != at) return kPass;
  if (log_file >= 0) dprintf(log_file, "fault %s\n", path);
  if (strcmp(what, "before") == 0) Kill();
  if (strcmp(what, "after") == 0) return kDie;
  if (strcmp(what, "short") == 0) return kShort;
  if (strcmp(what, "ENOSPC") == 0) return full = 1, needs_room ? kFail : kPass;
  errno = strcmp(what, "EINTR") == 0 ? EINTR : EIO;
  return kFail;
}

static enum Answer DecideOpen(int file, const char *kind, int needs_room) {
  char link[32], path[PATH_MAX] = "";
  if (under[0] == '\0') return kPass;
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  return readlink(link, path, sizeof path - 1) > 0 ? Decide(kind, path, needs_room) : kPass;
}

static int MakesFile(const char *path, int flags) {
  return (flags & O_CREAT) != 0 && access(path, F_OK) != 0;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
// CALL: the call as it is; SHORT: with half of its bytes
#define GO(TYPE, DECISION, CALL, SHORT)                \
  const enum Answer answer = DECISION;                 \
  if (answer == kFail) return (TYPE)-1;                \
  const TYPE result = answer == kShort ? SHORT : CALL; \
  if (answer == kDie) Kill();                          \
  return result
#define MODE                      \
  va_list rest;                   \
  va_start(rest, flags);          \
  const int mode = flags & O_CREAT ? va_arg(rest, int) : 0; \
  va_end(rest)
#define OPEN(name)                                                                            \
  int name(const char *path, int flags, ...) {                                                \
    MODE;                                                                                     \
    GO(int, Decide("open", path, MakesFile(path, flags)), NEXT(name)(path, flags, mode),             \
       NEXT(name)(path, flags, mode));                                                        \
  }
#define OPEN_AT(name)                                                                         \
  int name(int folder, const char *path, int flags, ...) {                                    \
    MODE;                                                                                     \
    GO(int, Decide("open", path, MakesFile(path, flags)), NEXT(name)(folder, path, flags, mode),     \
       NEXT(name)(folder, path, flags, mode));                                                \
  }
#define BYTES(name, kind, room, POINTER)                                                      \
  ssize_t name(int file, POINTER data, size_t size) {                                         \
    GO(ssize_t, DecideOpen(file, kind, room), NEXT(name)(file, data, size),                   \
       NEXT(name)(file, data, (size + 1) / 2));                                               \
  }
#define BYTES_AT(name, kind, room, POINTER)                                                   \
  ssize_t name(int file, POINTER data, size_t size, off_t where) {                            \
    GO(ssize_t, DecideOpen(file, kind, room), NEXT(name)(file, data, size, where),            \
       NEXT(name)(file, data, (size + 1) / 2, where));                                        \
  }
#define PLAIN(name, ARGUMENTS, DECISION, CALL) \
  int name ARGUMENTS { GO(int, DECISION, NEXT(name) CALL, NEXT(name) CALL); }

OPEN(open)
OPEN(open64)
OPEN_AT(openat)
OPEN_AT(openat64)
BYTES(write, "write", 1, const void *)
BYTES(read, "read", 0, void *)
BYTES_AT(pwrite, "write", 1, const void *)
BYTES_AT(pwrite64, "write", 1, const void *)
BYTES_AT(pread, "read", 0, void *)
BYTES_AT(pread64, "read", 0, void *)
PLAIN(rename, (const char *from, const char *to), Decide("rename", to, 0), (from, to))
PLAIN(renameat, (int a, const char *from, int b, const char *to), Decide("rename", to, 0),
      (a, from, b, to))
PLAIN(fsync, (int file), DecideOpen(file, "sync", 0), (file))
PLAIN(fdatasync, (int file), DecideOpen(file, "sync", 0), (file))
PLAIN(mkdir, (const char *path, mode_t mode), Decide("mkdir", path, 1), (path, mode))
PLAIN(ftruncate, (int file, off_t size), DecideOpen(file, "truncate", 1), (file, size))
PLAIN(ftruncate64, (int file, off_t size), DecideOpen(file, "truncate", 1), (file, size))
PLAIN(unlink, (const char *path), Decide("unlink", path, 0), (path))

ssize_t writev(int file, const struct iovec *parts, int count) {
  GO(ssize_t, DecideOpen(file, "write", 1), NEXT(writev)(file, parts, count),
     NEXT(write)(file, parts[0].iov_base, (parts[0].iov_len + 1) / 2));
}

FILE *fopen(const char *path, const char *mode) {  // for reading; what it reads is not seen
  const enum Answer answer = Decide("open", path, strchr(mode, 'w') != NULL);
  if (answer == kFail) return NULL;
  FILE *const file = NEXT(fopen)(path, mode);
  if (answer == kDie) Kill();
  return file;
}

int close(int file) {  // frees the descriptor in any case, as Linux does
  const enum Answer answer = DecideOpen(file, "close", 0);
  const int code = errno, result = NEXT(close)(file);
  if (answer == kDie) Kill();
  if (answer == kFail) errno = code;
  return answer == kFail ? -1 : result;
}

// Allocations, counted while main() runs.
extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static int Refuses(size_t size) {
  if (!in_main || size < (size_t)least || strcmp(at_kind, "alloc") != 0) return 0;
  const long count = __atomic_add_fetch(&allocations, 1, __ATOMIC_SEQ_CST);
  if (count != at) return 0;
  if (log_file >= 0) dprintf(log_file, "fault %zu bytes\n", size);
  return errno = ENOMEM, 1;
}

void *malloc(size_t size) { return Refuses(size) ? NULL : __libc_malloc(size); }
void *calloc(size_t n, size_t size) { return Refuses(n * size) ? NULL : __libc_calloc(n, size); }
void *realloc(void *old, size_t size) { return Refuses(size) ? NULL : __libc_realloc(old, size); }
void *aligned_alloc(size_t to, size_t size) {
  return Refuses(size) ? NULL : __libc_memalign(to, size);
}

static int (*program)(int, char **, char **);

static int CountedMain(int argc, char **argv, char **environment) {
  in_main = 1;
  const int code = program(argc, argv, environment);
  in_main = 0;
  if (log_file >= 0) dprintf(log_file, "allocations %ld\n", allocations);
  return code;
}

typedef int (*Start)(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void),
                     void (*)(void), void *);
int __libc_start_main(int (*own_main)(int, char **, char **), int argc, char **argv,
                      void (*init)(void), void (*fini)(void), void (*rtld_fini)(void),
                      void *stack_end) {
  program = own_main;
  return ((Start)dlsym(RTLD_NEXT, "__libc_start_main"))(CountedMain, argc, argv, init, fini,
                                                        rtld_fini, stack_end);
}
