// What the sanitizers of an executable do unless ASAN_OPTIONS or UBSAN_OPTIONS say otherwise. MPI
// leaves memory behind at its end. Containers that LAMMPS, which is not instrumented, has changed
// look as if they had overflowed.

extern "C" const char *__asan_default_options();
extern "C" const char *__ubsan_default_options();

const char *__asan_default_options()
{
  return "detect_leaks=0:detect_container_overflow=0:detect_odr_violation=0";
}

const char *__ubsan_default_options()
{
  return "print_stacktrace=1";
}
