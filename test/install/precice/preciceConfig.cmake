# A stand-in for preCICE, which Debian does not have: drivers/examples/precice is built and run with it.
if(NOT TARGET precice::precice)
  add_library(precice::precice INTERFACE IMPORTED)
  set_target_properties(precice::precice PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_LIST_DIR})
endif()
