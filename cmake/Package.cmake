# The Debian package that `cpack -G DEB` makes of what is installed; scripts/deb.sh builds it.
set(CPACK_PACKAGE_NAME user-rbc)
set(CPACK_PACKAGE_VENDOR "USER-RBC developers")
set(CPACK_PACKAGE_CONTACT "USER-RBC developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "suspensions of red blood cells in LAMMPS")
set(CPACK_PACKAGE_DESCRIPTION "Executable lmp_rbc with the styles of USER-RBC: elastic
cells in a viscous fluid on a grid, adhesion, vessels. Plugin, cell templates,
materials, Python tools and manual.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin, python3-numpy, python3-matplotlib, \
python3-vtk9, python3-pil, xvfb, ffmpeg")
if(LAMMPS_DEBIAN)    # one version of LAMMPS differs from the next under the same soname
  file(REAL_PATH ${library} real)
  execute_process(COMMAND dpkg-query -S ${real} OUTPUT_VARIABLE package COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE ":.*" "" package ${package})
  math(EXPR next "${LAMMPS_DATE} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "${package} (>= ${LAMMPS_DATE}), ${package} (<< ${next})")
else()
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${LAMMPS_BUILD_DIR})
endif()
include(CPack)
