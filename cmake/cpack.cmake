# Debian packages, from the build folder: cpack -G DEB. suture: programs, library, guide, scenes; suture-dev: headers, CMake and pkg-config;
# python3-suture: files installed with COMPONENT python, if any.
set(CPACK_PACKAGE_NAME suture)
set(CPACK_PACKAGE_VENDOR "The Suture authors")
set(CPACK_PACKAGE_CONTACT "The Suture authors <maintainers@users.noreply.h-seed-0caebacc.example>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages_deb)
set(CPACK_GENERATOR DEB)
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_IGNORE_FILES "/\\\\.git/;/build[^/]*/;/out[^/]*/;_out/;/__pycache__/")

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL runtime dev)
get_cmake_property(components COMPONENTS)
if(python IN_LIST components)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME suture)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "openmpi-bin, python3, python3-numpy, python3-h5py, python3-matplotlib, python3-pil")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libjs-three, python3-meshio, python3-netcdf4")  # 3D reports, some formats of suture_convert
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/packaging/deb/prerm)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "suture-dev, gmsh, paraview")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "elastic bodies in contact, solved by domain decomposition
Contact areas, contact pressures and stresses: plane, axisymmetric or 3D, small strains, with and without friction, in parallel
by MPI. Programs, library, guide and scenes. As a binary it is under the GPL, by CHOLMOD's supernodal module, SuiteSparseQR and Gmsh.")

# Debian's configuration of Trilinos requires the components it was built with; cmake/bootstrap.sh lists them.
file(STRINGS ${CMAKE_SOURCE_DIR}/cmake/bootstrap.sh lines REGEX "-dev")
string(REGEX MATCHALL "(libtrilinos-[a-z0-9-]+|libptscotch|libmumps|libeigen3|libopenmpi)-dev" names "${lines}")
list(REMOVE_DUPLICATES names)
list(JOIN names ", " names)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME suture-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "suture (= ${PROJECT_VERSION}), ${names}")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "cmake, pkg-config")
set(CPACK_DEBIAN_DEV_DESCRIPTION "contact of elastic bodies: headers of the library Suture
For programs and plugins in C++17, by find_package(Suture) of CMake or by pkg-config.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-suture)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/packaging/deb/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "suture (= ${PROJECT_VERSION}), python3, python3-numpy, python3-mpi4py")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-meshio, python3-gmsh")  # for meshes from memory
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "contact of elastic bodies: Suture from Python
Scenes from files or dictionaries, solved on an mpi4py communicator, answers as numpy arrays.")

# Each package has its copyright file; a plain `cmake --install` installs LICENSE.
file(READ ${CMAKE_SOURCE_DIR}/LICENSE text)
string(REGEX REPLACE "^[^\n]*\n\n[^\n]*\n\n" "" text "${text}")
string(REGEX REPLACE "\n\n" "\n.\n" text "${text}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" text " ${text}")
configure_file(${CMAKE_SOURCE_DIR}/packaging/deb/copyright.in ${CMAKE_BINARY_DIR}/copyright @ONLY)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  install(FILES ${CMAKE_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} COMPONENT ${component}
    EXCLUDE_FROM_ALL)
endforeach()
include(CPack)
