// SPDX-License-Identifier: GPL-3.0-or-later
// A library to preload (LD_PRELOAD) that makes one call of a program fail:
//   PHONGPD_FAIL_CALL=KIND:N   the N-th call (from 1) of the kind; "KIND:N+"
//                              that one and all after it
//   PHONGPD_COUNT_CALLS=FILE   at the end, "KIND COUNT" for every kind
// Kinds: open (that creates), write, sync, rename, link, mkdir, truncate, new,
// thread.  Standard input, output and error are left alone.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

enum Kind {
  kOpen,
  kWrite,
  kSync,
  kRename,
  kLink,
  kMkdir,
  kTruncate,
  kNew,
  kThread,
  kKinds
};
constexpr const char* kNames[kKinds] = {"open",     "write", "sync",
                                        "rename",   "link",  "mkdir",
                                        "truncate", "new",   "thread"};

std::atomic<long> calls[kKinds];

// Set before main, when no thread runs.
long fails_at[kKinds];
bool fails_after[kKinds];

bool Fails(Kind kind) {
  const long call = ++calls[kind];
  const long at = fails_at[kind];
  return at > 0 && (call == at || (fails_after[kind] && call > at));
}

__attribute__((constructor)) void ReadOrder() {
  const char* const order = std::getenv("PHONGPD_FAIL_CALL");
  if (order == nullptr) return;
  const char* const colon = std::strchr(order, ':');
  if (colon == nullptr) return;
  for (int kind = 0; kind < kKinds; ++kind) {
    const auto length = static_cast<std::size_t>(colon - order);
    if (std::strlen(kNames[kind]) != length ||
        std::strncmp(order, kNames[kind], length) != 0) {
      continue;
    }
    // Not counted: what ran before main.
    calls[kind] = 0;
    fails_at[kind] = std::atol(colon + 1);
    fails_after[kind] = order[std::strlen(order) - 1] == '+';
  }
}

template <typename Function>
Function Real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool IsStandard(int file) { return 0 <= file && file <= 2; }

__attribute__((destructor)) void WriteCounts() {
  const char* const path = std::getenv("PHONGPD_COUNT_CALLS");
  if (path == nullptr) return;
  std::FILE* const file = std::fopen(path, "w");
  if (file == nullptr) return;
  for (int kind = 0; kind < kKinds; ++kind) {
    std::fprintf(file, "%s %ld\n", kNames[kind], calls[kind].load());
  }
  std::fclose(file);
}

int Refuse(int error) {
  errno = error;
  return -1;
}

void* Allocate(std::size_t size, std::size_t alignment) {
  if (Fails(kNew)) return nullptr;
  if (alignment == 0) return std::malloc(size > 0 ? size : 1);
  return std::aligned_alloc(alignment,
                            (size + alignment - 1) / alignment * alignment);
}

void* AllocateOrThrow(std::size_t size, std::size_t alignment) {
  void* const memory = Allocate(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode =
      (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_CREAT) != 0 && Fails(kOpen)) return Refuse(EMFILE);
  static const auto real = Real<int (*)(const char*, int, mode_t)>("open");
  return real(path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode =
      (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_CREAT) != 0 && Fails(kOpen)) return Refuse(EMFILE);
  static const auto real =
      Real<int (*)(int, const char*, int, mode_t)>("openat");
  return real(folder, path, flags, mode);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  static const auto real =
      Real<ssize_t (*)(int, const void*, std::size_t)>("write");
  if (!IsStandard(file) && Fails(kWrite)) {
    // As a full disk does: some of it fits.
    if (size > 1 && real(file, bytes, size / 2) < 0) return -1;
    return Refuse(ENOSPC);
  }
  return real(file, bytes, size);
}

int fsync(int file) {
  if (Fails(kSync)) return Refuse(EIO);
  return Real<int (*)(int)>("fsync")(file);
}

int rename(const char* from, const char* to) {
  if (Fails(kRename)) return Refuse(EIO);
  return Real<int (*)(const char*, const char*)>("rename")(from, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  if (Fails(kRename)) return Refuse(EIO);
  return Real<int (*)(int, const char*, int, const char*)>("renameat")(
      from_folder, from, to_folder, to);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to,
           int flags) {
  if (Fails(kLink)) return Refuse(EIO);
  return Real<int (*)(int, const char*, int, const char*, int)>("linkat")(
      from_folder, from, to_folder, to, flags);
}

int mkdir(const char* path, mode_t mode) {
  if (Fails(kMkdir)) return Refuse(ENOSPC);
  return Real<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

int ftruncate(int file, off_t size) {
  if (Fails(kTruncate)) return Refuse(EIO);
  return Real<int (*)(int, off_t)>("ftruncate")(file, size);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                   void* (*run)(void*), void* argument) {
  if (Fails(kThread)) return EAGAIN;
  return Real<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*),
                      void*)>("pthread_create")(thread, attributes, run,
                                                argument);
}

}  // extern "C"

void* operator new(std::size_t size) { return AllocateOrThrow(size, 0); }
void* operator new[](std::size_t size) { return AllocateOrThrow(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return AllocateOrThrow(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return AllocateOrThrow(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return Allocate(size, 0);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return Allocate(size, 0);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
