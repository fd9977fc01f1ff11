# Our own code with the sanitizers of RBC_SANITIZE; LAMMPS stays as it was built. The executable holds their runtime,
# so that it comes before all other libraries, the plugin among them.
if(NOT RBC_SANITIZE)
  return()
endif()

set(sanitize -fsanitize=${RBC_SANITIZE})
if(RBC_SANITIZE MATCHES undefined)
  # beyond the standard set: conversions of numbers too large for an integer
  list(APPEND sanitize -fsanitize=float-cast-overflow -fno-sanitize-recover=all)
endif()
if(RBC_FUZZ)
  target_compile_options(rbc_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
target_compile_options(rbc_flags INTERFACE ${sanitize} -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS)
target_link_options(rbc_flags INTERFACE ${sanitize})
# GCC finds uninitialised values in what it has instrumented (GCC bug 105562 and others)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(rbc_flags INTERFACE -Wno-maybe-uninitialized)
else()    # clang cannot vectorise loops with checks in them
  target_compile_options(rbc_flags INTERFACE -Wno-pass-failed)
endif()
target_sources(rbc_flags INTERFACE
  $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${PROJECT_SOURCE_DIR}/cmake/sanitizer_defaults.cpp>)
