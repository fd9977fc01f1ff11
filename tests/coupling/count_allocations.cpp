// A library for LD_PRELOAD that counts the allocations of our own code, by the place that makes
// them.
//
// It takes the place of malloc and its relatives, which operator new calls, too. An allocation is
// ours if the first caller that is no part of an allocator or of the standard library lies in an
// object whose file name contains one of the words of COUNT_ALLOCATIONS_OF, separated by colons.
// When the program ends, the file allocations.<pid> in the folder where it started has a line for
// each place: object, offset in it, number of allocations, symbol. It relies on glibc, whose names
// __libc_malloc and so on lead to the allocator itself.

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <initializer_list>
#include <limits.h>
#include <unistd.h>
#include <unwind.h>

extern "C" {
void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
}

namespace {

enum class Owner { NONE, PASSED_ON, OURS, OTHERS };

// Memory of the counter itself is fixed, as it must not allocate. It takes no lock, because the
// loader holds its own one both where it allocates and where it is asked for an object.
struct Place {
  std::atomic<uintptr_t> address{0};
  std::atomic<Owner> owner{Owner::NONE};
  std::atomic<long> count{0};
};

constexpr size_t places = 1 << 16;
Place table[places];
char folder[PATH_MAX];
char words[PATH_MAX];
thread_local bool counting __attribute__((tls_model("initial-exec"))) = false;

bool begins_with(const char *text, const char *start)
{
  return strncmp(text, start, strlen(start)) == 0;
}

const char *base_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

// The standard library's templates are compiled into whatever uses them, and LAMMPS's Memory
// allocates for its callers. Both pass on what others ask for.
Owner owner_of(uintptr_t address)
{
  Dl_info info;
  if (!dladdr(reinterpret_cast<void *>(address - 1), &info) || !info.dli_fname)
    return Owner::OTHERS;
  const char *file = base_name(info.dli_fname);
  for (const char *library :
       {"libc.so", "libc-", "libstdc++", "libgcc_s", "ld-linux", "libcount_allocations"})
    if (begins_with(file, library)) return Owner::PASSED_ON;
  if (info.dli_sname)
    for (const char *scope : {"_ZSt", "_ZNSt", "_ZNKSt", "_ZN9__gnu_cxx", "_ZN9LAMMPS_NS6Memory"})
      if (begins_with(info.dli_sname, scope)) return Owner::PASSED_ON;
  for (const char *word = words; *word;) {
    const size_t length = strcspn(word, ":");
    if (length && memmem(file, strlen(file), word, length)) return Owner::OURS;
    word += length + (word[length] == ':');
  }
  return Owner::OTHERS;
}

Place *place_of(uintptr_t address)
{
  size_t n = (address * 0x9E3779B97F4A7C15ull >> 40) % places;
  for (size_t tries = 0; tries < places; ++tries, n = (n + 1) % places) {
    uintptr_t there = 0;
    if (table[n].address.compare_exchange_strong(there, address) || there == address) {
      if (table[n].owner == Owner::NONE) table[n].owner = owner_of(address);
      return &table[n];
    }
  }
  return nullptr;
}

_Unwind_Reason_Code visit(_Unwind_Context *context, void *)
{
  const uintptr_t address = _Unwind_GetIP(context);
  Place *place = address ? place_of(address) : nullptr;
  if (!place) return _URC_END_OF_STACK;
  if (place->owner == Owner::PASSED_ON) return _URC_NO_REASON;
  if (place->owner == Owner::OURS) ++place->count;
  return _URC_END_OF_STACK;
}

void count()
{
  if (counting || !words[0]) return;
  counting = true;
  _Unwind_Backtrace(visit, nullptr);
  counting = false;
}

__attribute__((constructor)) void start()
{
  const char *of = getenv("COUNT_ALLOCATIONS_OF");
  if (!of || !getcwd(folder, sizeof folder - 32)) return;
  strncpy(words, of, sizeof words - 1);
}

__attribute__((destructor)) void finish()
{
  if (!words[0]) return;
  counting = true;
  char path[PATH_MAX + 32];
  snprintf(path, sizeof path, "%s/allocations.%d", folder, static_cast<int>(getpid()));
  FILE *file = nullptr;
  for (const Place &place : table) {
    if (place.count == 0) continue;
    if (!file && !(file = fopen(path, "w"))) return;
    Dl_info info;
    // A plugin may have been unloaded by now.
    if (!dladdr(reinterpret_cast<void *>(place.address.load() - 1), &info))
      info = {"?", nullptr, nullptr, nullptr};
    fprintf(
        file, "%s 0x%zx %ld %s\n", info.dli_fname,
        static_cast<size_t>(place.address.load() - 1 - reinterpret_cast<uintptr_t>(info.dli_fbase)),
        place.count.load(), info.dli_sname ? info.dli_sname : "?");
  }
  if (file) fclose(file);
}

}    // namespace

extern "C" {

void *malloc(size_t size)
{
  count();
  return __libc_malloc(size);
}

void *calloc(size_t number, size_t size)
{
  count();
  return __libc_calloc(number, size);
}

void *realloc(void *old, size_t size)
{
  count();
  return __libc_realloc(old, size);
}

void *memalign(size_t alignment, size_t size)
{
  count();
  return __libc_memalign(alignment, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
  count();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void **result, size_t alignment, size_t size)
{
  count();
  *result = __libc_memalign(alignment, size);
  return *result || !size ? 0 : ENOMEM;
}
}
