# Installation in components. runtime: libsuture.so, the programs, guide and scenes; dev: headers and the files of find_package(Suture) and
# pkg-config; python: files that python/ installs with COMPONENT python. A downstream project links Suture::suture and gets Trilinos, MPI and Eigen with it.
include(CMakePackageConfigHelpers)

if(CMAKE_INSTALL_DOCDIR STREQUAL "${CMAKE_INSTALL_DATAROOTDIR}/doc/${PROJECT_NAME}")
  set(CMAKE_INSTALL_DOCDIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/suture)
endif()
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)

set(SUTURE_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Suture)
foreach(target options trilinos eigen)
  set_target_properties(suture_${target} PROPERTIES EXPORT_NAME ${target})
endforeach()
install(TARGETS suture suture_options suture_trilinos suture_eigen EXPORT SutureTargets LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev)
install(EXPORT SutureTargets NAMESPACE Suture:: DESTINATION ${SUTURE_CONFIG_DIR} COMPONENT dev)
# Next to the headers of base, so that sources of this tree include it in the same way.
configure_file(${CMAKE_SOURCE_DIR}/cmake/Version.hpp.in ${CMAKE_BINARY_DIR}/include/base/suture/Version.hpp @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/include/base/suture/Version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/suture COMPONENT dev)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/packages/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/suture COMPONENT dev FILES_MATCHING PATTERN "*.hpp")

# The programs find the library relative to themselves, so that the folder can be moved.
file(RELATIVE_PATH suture_bin_to_lib /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
foreach(program suture_solve suture_study suture_partition_program suture_schema suture_new)
  if(TARGET ${program})
    set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/${suture_bin_to_lib}")
    install(TARGETS ${program})
  endif()
endforeach()
if(EXISTS ${CMAKE_SOURCE_DIR}/drivers/plot/suture_plot)
  install(PROGRAMS ${CMAKE_SOURCE_DIR}/drivers/plot/suture_plot ${CMAKE_SOURCE_DIR}/drivers/plot/suture_study_plot
    ${CMAKE_SOURCE_DIR}/drivers/convert/suture_convert DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/drivers/convert/suture_convert_formats ${CMAKE_SOURCE_DIR}/drivers/plot/suture_plot_parts
    DESTINATION ${CMAKE_INSTALL_DATADIR}/suture FILES_MATCHING PATTERN "*.py" PATTERN "*.js" PATTERN "*.css")
  foreach(parts suture_convert_formats suture_plot_parts)
    configure_file(${CMAKE_SOURCE_DIR}/cmake/version.py.in ${CMAKE_BINARY_DIR}/drivers/${parts}/version.py @ONLY)
    install(FILES ${CMAKE_BINARY_DIR}/drivers/${parts}/version.py DESTINATION ${CMAKE_INSTALL_DATADIR}/suture/${parts})
  endforeach()
endif()
install(FILES ${CMAKE_SOURCE_DIR}/packages/elasticity/materials/materials.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/suture)
if(TARGET suture_mesher)
  install(TARGETS suture_mesher DESTINATION ${CMAKE_INSTALL_LIBDIR}/suture)
endif()
# bash looks for a file named like the command.
foreach(program suture_solve suture_study suture_partition suture_schema suture_new suture_plot suture_study_plot suture_convert)
  install(FILES ${CMAKE_SOURCE_DIR}/drivers/completion/suture.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${program})
endforeach()

# All that `cmake --install` needs, without tests: bootstrap.sh build makes this target. test/install checks that it is complete.
add_custom_target(suture_installed)
foreach(target suture suture_mesher suture_solve suture_study suture_partition_program suture_schema suture_new suture_plot_script
    suture_convert_script suture_python suture_python_sources)
  if(TARGET ${target})
    add_dependencies(suture_installed ${target})
  endif()
endforeach()

configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/SutureConfig.cmake.in ${CMAKE_BINARY_DIR}/SutureConfig.cmake
  INSTALL_DESTINATION ${SUTURE_CONFIG_DIR} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/SutureConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/SutureConfig.cmake ${CMAKE_BINARY_DIR}/SutureConfigVersion.cmake DESTINATION ${SUTURE_CONFIG_DIR} COMPONENT dev)
include(cmake/pkgconfig.cmake)
include(cmake/documents.cmake)
include(cmake/cpack.cmake)
