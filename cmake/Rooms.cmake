# Each folder of the code, a room, is a library that sees its own headers and those of the rooms it is linked
# to, and no others. Headers are included with their room: #include "membrane/skalak.h".

# rbc_room(<name> <folder> [rooms and libraries it may see ...])
function(rbc_room name folder)
  set(view ${PROJECT_BINARY_DIR}/rooms/${name})
  file(MAKE_DIRECTORY ${view})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${view}/${name} SYMBOLIC)
  # messages name a header by its place in the source
  get_filename_component(parent ${folder} DIRECTORY)
  target_compile_options(rbc_flags INTERFACE
    "-fmacro-prefix-map=${view}/=${parent}/")
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  if(sources)
    add_library(room_${name} STATIC ${sources})
    target_include_directories(room_${name} PUBLIC ${view})
    target_link_libraries(room_${name} PUBLIC ${ARGN} PRIVATE rbc_flags)
  else()
    add_library(room_${name} INTERFACE)
    target_include_directories(room_${name} INTERFACE ${view})
    target_link_libraries(room_${name} INTERFACE ${ARGN})
  endif()
endfunction()
