# What `cmake --install` puts below a prefix, in the folders of Debian. Files find each other from
# where they are, so that the whole can be moved.
set(library_folder lib/user-rbc)
set(data_folder share/user-rbc)
set(pages_folder share/doc/user-rbc)

# Installs a link in a folder below the prefix.
function(rbc_install_link folder name target)
  install(CODE "set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${folder}\")
    file(MAKE_DIRECTORY \"\${folder}\")
    file(CREATE_LINK ${target} \"\${folder}/${name}\" SYMBOLIC)")
endfunction()

install(TARGETS rbcplugin LIBRARY DESTINATION ${library_folder})
if(TARGET lmp_rbc)
  target_compile_definitions(lmp_rbc PRIVATE RBC_PLUGIN_FOLDER="../${library_folder}"
    RBC_POTENTIALS_FOLDER="../${data_folder}/potentials")
  set_target_properties(lmp_rbc PROPERTIES INSTALL_RPATH "$ORIGIN/../${library_folder}")
  install(TARGETS lmp_rbc RUNTIME DESTINATION bin)
  configure_file(doc/lmp_rbc.1.in lmp_rbc.1 @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/lmp_rbc.1 DESTINATION share/man/man1)
endif()
if(LAMMPS_BUILD_DIR)    # the library that lmp_rbc was linked with, under its soname
  install(PROGRAMS ${LAMMPS_BUILD_DIR}/liblammps.so.0 DESTINATION ${library_folder})
  # LAMMPS's own Python module, which loads the library beside it
  set(python_folder ${data_folder}/python)
  install(DIRECTORY ${LAMMPS_SOURCE_DIR}/python/lammps DESTINATION ${python_folder} FILES_MATCHING
    PATTERN "*.py" PATTERN __pycache__ EXCLUDE)
  rbc_install_link(${python_folder}/lammps liblammps.so
    ../../../../${library_folder}/liblammps.so.0)
endif()

install(DIRECTORY potentials DESTINATION ${data_folder} FILES_MATCHING
  PATTERN "*.mol" PATTERN "*.material" PATTERN "*.blood" PATTERN "*.py" PATTERN README.md
  PATTERN __pycache__ EXCLUDE)
install(DIRECTORY scripts DESTINATION ${data_folder} FILES_MATCHING
  PATTERN "*.py" PATTERN __pycache__ EXCLUDE PATTERN "validation*.py" EXCLUDE)
# below /usr Python finds the package rbc there
rbc_install_link(lib/python3/dist-packages rbc ../../../${data_folder}/scripts/rbc)
file(GLOB scenes RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
  examples/*/in.* examples/blood/seeds.py examples/fahraeus/cells.txt examples/fahraeus/velocity.py
  examples/python/*.py)
foreach(scene ${scenes})
  get_filename_component(folder ${scene} DIRECTORY)
  install(FILES ${scene} DESTINATION ${data_folder}/${folder})
endforeach()

install(FILES CHANGELOG.md DESTINATION ${pages_folder})
install(FILES LICENSE DESTINATION ${pages_folder} RENAME copyright)
# of scripts/html.sh
install(DIRECTORY ${PROJECT_BINARY_DIR}/html DESTINATION ${pages_folder} OPTIONAL)
