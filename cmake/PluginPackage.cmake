# Debian's liblammps has no package PLUGIN: lmp_rbc brings it along. So does lmp, an executable like
# LAMMPS's own, for tests.
add_library(plugin_package OBJECT src/plugin_package.cpp ${LAMMPS_SOURCE_DIR}/src/PLUGIN/plugin.cpp)
target_include_directories(plugin_package PUBLIC ${LAMMPS_SOURCE_DIR}/src/PLUGIN)
target_compile_definitions(plugin_package PRIVATE LMP_PLUGIN)
target_link_libraries(plugin_package PUBLIC LAMMPS::lammps)

add_executable(lmp ${LAMMPS_SOURCE_DIR}/src/main.cpp)
target_link_libraries(lmp PRIVATE LAMMPS::lammps)
foreach(executable lmp lmp_rbc)
  target_link_libraries(${executable} PRIVATE plugin_package ${CMAKE_DL_LIBS})
  set_target_properties(${executable} PROPERTIES ENABLE_EXPORTS ON)
endforeach()
set(LAMMPS_EXECUTABLE ${PROJECT_BINARY_DIR}/lmp)
