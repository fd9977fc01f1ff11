# Included by LAMMPS's own CMakeLists.txt where scripts/lammps.sh builds it. Half of the time that a
# file of LAMMPS takes is for these headers, which nearly all of them include.
cmake_language(DEFER CALL target_precompile_headers lammps PRIVATE
  <pointers.h> <algorithm> <cmath> <cstring> <map> <set> <string> <vector>)
