# LAMMPS's headers (target LAMMPS::headers) and, where it has been built or is Debian's, its library
# (LAMMPS::lammps). Without a folder given, they are those of scripts/lammps.sh; with the source
# alone, only the plugin is built.

set(LAMMPS_SOURCE_DIR "" CACHE PATH "Top folder of a LAMMPS source tree")
set(LAMMPS_BUILD_DIR "" CACHE PATH "Where it was built by CMake as a shared library with package PLUGIN")
set(LAMMPS_SIZES "" CACHE STRING "Its integer sizes, smallbig or bigbig (default: as in LAMMPS_BUILD_DIR, or smallbig)")
set(LAMMPS_VERSION 4Feb2025 CACHE STRING "Of scripts/lammps.sh, where no folder is given: 4Feb2025 or newest")

option(LAMMPS_DEBIAN "Link with Debian's liblammps, whose source LAMMPS_SOURCE_DIR holds" OFF)

if((LAMMPS_BUILD_DIR OR LAMMPS_DEBIAN) AND NOT LAMMPS_SOURCE_DIR)
  message(FATAL_ERROR "LAMMPS_BUILD_DIR and LAMMPS_DEBIAN need LAMMPS_SOURCE_DIR")
endif()
if(NOT LAMMPS_SOURCE_DIR)
  set(scripts ${PROJECT_SOURCE_DIR}/scripts)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${scripts}/common.sh ${scripts}/lammps_version.sh)
  execute_process(
    COMMAND bash -c ". ./common.sh; . ./lammps_version.sh $0
      echo \"$LAMMPS_HOME/source;$LAMMPS_BUILD;$LAMMPS_DEBIAN\"" ${LAMMPS_VERSION}
    WORKING_DIRECTORY ${scripts} OUTPUT_VARIABLE folders OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  list(GET folders 0 LAMMPS_SOURCE_DIR)
  list(GET folders 1 LAMMPS_BUILD_DIR)
  list(GET folders 2 LAMMPS_DEBIAN)
  set(built_by "; bash scripts/lammps.sh ${LAMMPS_VERSION} builds it")
endif()

if(NOT EXISTS ${LAMMPS_SOURCE_DIR}/src/lammps.h)
  message(FATAL_ERROR "No LAMMPS source in ${LAMMPS_SOURCE_DIR}${built_by}")
endif()

set(sizes smallbig)
if(LAMMPS_DEBIAN)
  set(LAMMPS_BUILD_DIR "")
  pkg_check_modules(DEBIAN_LAMMPS REQUIRED liblammps)
  file(STRINGS ${LAMMPS_SOURCE_DIR}/src/version.h version REGEX LAMMPS_VERSION)
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" version "${version}")
  # 20250204 to pkg-config, 2026.7.4 and the number of an update since 2026
  execute_process(COMMAND date -u -d "${version}" "+%Y%m%d|%Y[.]%-m[.]%-d[.][0-9]+"
    OUTPUT_VARIABLE dates OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[|].*" "" LAMMPS_DATE "${dates}")
  if(NOT DEBIAN_LAMMPS_VERSION MATCHES "^(${dates})$")
    message(FATAL_ERROR "LAMMPS_SOURCE_DIR is of ${version}, liblammps of ${DEBIAN_LAMMPS_VERSION}")
  endif()
  if(DEBIAN_LAMMPS_CFLAGS_OTHER MATCHES "LAMMPS_([A-Z]+)")
    set(sizes ${CMAKE_MATCH_1})
  endif()
  find_library(library lammps HINTS ${DEBIAN_LAMMPS_LIBDIR} NO_CACHE REQUIRED)
elseif(LAMMPS_BUILD_DIR)
  set(library ${LAMMPS_BUILD_DIR}/liblammps.so)
  if(NOT EXISTS ${library} OR NOT EXISTS ${LAMMPS_BUILD_DIR}/CMakeCache.txt)
    message(FATAL_ERROR "No LAMMPS shared library built by CMake in ${LAMMPS_BUILD_DIR}${built_by}")
  endif()
  load_cache(${LAMMPS_BUILD_DIR} READ_WITH_PREFIX BUILT_ LAMMPS_SIZES PKG_PLUGIN PKG_EXTRA-FIX)
  if(NOT BUILT_PKG_PLUGIN)
    message(FATAL_ERROR "The LAMMPS in ${LAMMPS_BUILD_DIR} lacks package PLUGIN")
  endif()
  set(sizes ${BUILT_LAMMPS_SIZES})
  set(LAMMPS_EXECUTABLE ${LAMMPS_BUILD_DIR}/lmp)
endif()
if(LAMMPS_SIZES)
  set(sizes ${LAMMPS_SIZES})
endif()
string(TOUPPER ${sizes} sizes)

# Of all that LAMMPS's own build defines, only the integer sizes change what its headers declare.
add_library(LAMMPS::headers INTERFACE IMPORTED)
target_include_directories(LAMMPS::headers INTERFACE ${LAMMPS_SOURCE_DIR}/src)
if(EXISTS ${LAMMPS_SOURCE_DIR}/third_party)
  target_include_directories(LAMMPS::headers INTERFACE ${LAMMPS_SOURCE_DIR}/third_party)
endif()
target_compile_definitions(LAMMPS::headers INTERFACE LAMMPS_${sizes})
target_link_libraries(LAMMPS::headers INTERFACE MPI::MPI_CXX)

if(library)
  add_library(LAMMPS::lammps SHARED IMPORTED)
  set_target_properties(LAMMPS::lammps PROPERTIES IMPORTED_LOCATION ${library})
  target_link_libraries(LAMMPS::lammps INTERFACE LAMMPS::headers)
endif()

message(STATUS "LAMMPS ${sizes}: ${LAMMPS_SOURCE_DIR}")
