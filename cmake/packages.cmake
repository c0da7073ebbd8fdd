# The packages in the order of the data flow. A package may include only packages to its left: each is a separate target whose include
# path has only its predecessors, so that a wrong #include does not compile. All packages together make one libsuture.so.
set(SUTURE_ALL_PACKAGES base algebra mesh reader pairs constraints partition elasticity subdomain search motion interface answer precond solver condensed monolithic adapt report simulation)
set(SUTURE_LAST_PACKAGE "" CACHE STRING "The last package to build, for work on a leading part of the list; empty: all")
# Not cached: a build folder of an older version must not keep the old list.
set(SUTURE_PACKAGES ${SUTURE_ALL_PACKAGES})
if(SUTURE_LAST_PACKAGE)
  list(FIND SUTURE_ALL_PACKAGES "${SUTURE_LAST_PACKAGE}" last)
  if(last LESS 0)
    message(FATAL_ERROR "SUTURE_LAST_PACKAGE: '${SUTURE_LAST_PACKAGE}' is none of ${SUTURE_ALL_PACKAGES}")
  endif()
  math(EXPR last "${last} + 1")
  list(SUBLIST SUTURE_ALL_PACKAGES 0 ${last} SUTURE_PACKAGES)
endif()

# suture_package(name SOURCES a.cpp b.cpp LINK suture::x): one folder under packages/.
function(suture_package name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  # <suture/name/X.hpp> is packages/name/X.hpp
  set(root ${CMAKE_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${root}/suture)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/suture/${name} SYMBOLIC)

  add_library(suture_${name} OBJECT ${ARG_SOURCES})
  target_include_directories(suture_${name} PUBLIC ${root})
  target_compile_options(suture_${name} PRIVATE ${SUTURE_WARNINGS})
  target_link_libraries(suture_${name} PUBLIC suture_options suture::trilinos suture::eigen PRIVATE ${ARG_LINK})
  foreach(predecessor ${SUTURE_ALL_PACKAGES})
    if(predecessor STREQUAL name)
      break()
    endif()
    target_include_directories(suture_${name} PUBLIC ${CMAKE_BINARY_DIR}/include/${predecessor})
  endforeach()

  set_target_properties(suture_${name} PROPERTIES UNITY_BUILD ${SUTURE_UNITY} UNITY_BUILD_BATCH_SIZE 40)
  target_precompile_headers(suture_${name} REUSE_FROM suture_headers)

  target_sources(suture PRIVATE $<TARGET_OBJECTS:suture_${name}>)
  target_link_libraries(suture PRIVATE ${ARG_LINK})
  target_include_directories(suture PUBLIC $<BUILD_INTERFACE:${root}>)
endfunction()
