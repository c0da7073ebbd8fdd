# A substitute for preCICE, which Debian does not have, to build and run drivers/examples/precice.
if(NOT TARGET precice::precice)
  add_library(precice::precice INTERFACE IMPORTED)
  set_target_properties(precice::precice PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_LIST_DIR})
endif()
