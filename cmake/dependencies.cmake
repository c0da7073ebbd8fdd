# All dependencies of Suture as imported targets: suture::trilinos, suture::intrepid2, suture::cholmod, suture::metis, suture::gmsh,
# suture::muparser, suture::hdf5, suture::eigen, suture::blas. Their headers are SYSTEM, so that warnings concern only our code.

find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Trilinos REQUIRED COMPONENTS Tpetra Belos Amesos2 Teuchos Intrepid2)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

# Trilinos libraries whose symbols are used by Suture's headers. Debian's targets are named trilinos_<library>, those of a Trilinos built from
# source <library>. Debian's carry no include directories.
set(SUTURE_TRILINOS_LIBRARIES belostpetra belos amesos2 tpetra kokkoscore teuchosparameterlist teuchosparser teuchosnumerics teuchoscomm teuchoscore)
set(intrepid2 intrepid2 shards)
if(TARGET trilinos_tpetra)
  list(TRANSFORM SUTURE_TRILINOS_LIBRARIES PREPEND trilinos_)
  list(TRANSFORM intrepid2 PREPEND trilinos_)
endif()
add_library(suture_trilinos INTERFACE)
add_library(suture::trilinos ALIAS suture_trilinos)
target_include_directories(suture_trilinos SYSTEM INTERFACE ${Trilinos_INCLUDE_DIRS} ${MPI_CXX_INCLUDE_DIRS})
target_link_libraries(suture_trilinos INTERFACE ${SUTURE_TRILINOS_LIBRARIES} MPI::MPI_CXX)

add_library(suture_intrepid2 INTERFACE)
add_library(suture::intrepid2 ALIAS suture_intrepid2)
target_link_libraries(suture_intrepid2 INTERFACE suture_trilinos ${intrepid2})

function(suture_find_library target)
  cmake_parse_arguments(ARG "" "HEADER" "LIBRARIES;SUFFIXES" ${ARGN})
  add_library(suture_${target} INTERFACE)
  add_library(suture::${target} ALIAS suture_${target})
  find_path(SUTURE_${target}_INCLUDE ${ARG_HEADER} PATH_SUFFIXES ${ARG_SUFFIXES} REQUIRED)
  target_include_directories(suture_${target} SYSTEM INTERFACE ${SUTURE_${target}_INCLUDE})
  foreach(library ${ARG_LIBRARIES})
    find_library(SUTURE_${target}_${library} ${library} PATH_SUFFIXES ${ARG_SUFFIXES} REQUIRED)
    target_link_libraries(suture_${target} INTERFACE ${SUTURE_${target}_${library}})
  endforeach()
endfunction()

suture_find_library(cholmod HEADER cholmod.h LIBRARIES spqr cholmod SUFFIXES suitesparse)
suture_find_library(metis HEADER metis.h LIBRARIES metis)
suture_find_library(muparser HEADER muParser.h LIBRARIES muparser)
suture_find_library(blas HEADER cblas.h LIBRARIES openblas SUFFIXES openblas-pthread x86_64-linux-gnu x86_64-linux-gnu/openblas-pthread)
if(SUTURE_GMSH)
  suture_find_library(gmsh HEADER gmsh.h LIBRARIES gmsh)
endif()

# Only the OpenMP run-time functions, to keep CHOLMOD's loops from spawning threads; with the compiler flag Eigen would spawn them. CHOLMOD uses
# GNU's library; calls to Clang's own library would have no effect on it.
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  set(OpenMP_CXX_FLAGS "-fopenmp=libgomp" CACHE STRING "OpenMP as CHOLMOD has it")
  set(OpenMP_CXX_LIB_NAMES "gomp" CACHE STRING "OpenMP as CHOLMOD has it")
  find_library(OpenMP_gomp_LIBRARY NAMES gomp libgomp.so.1)
endif()
find_package(OpenMP REQUIRED COMPONENTS CXX)
add_library(suture_openmp INTERFACE)
add_library(suture::openmp ALIAS suture_openmp)
target_link_libraries(suture_openmp INTERFACE ${OpenMP_CXX_LIBRARIES})

set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "Suture needs a parallel HDF5 (Debian: libhdf5-openmpi-dev)")
endif()
add_library(suture_hdf5 INTERFACE)
add_library(suture::hdf5 ALIAS suture_hdf5)
target_include_directories(suture_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(suture_hdf5 INTERFACE ${HDF5_LIBRARIES})
target_compile_definitions(suture_hdf5 INTERFACE ${HDF5_DEFINITIONS})

add_library(suture_eigen INTERFACE)
add_library(suture::eigen ALIAS suture_eigen)
get_target_property(suture_eigen_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(suture_eigen SYSTEM INTERFACE ${suture_eigen_include})

set(gmsh_note "off")
if(SUTURE_GMSH)
  set(gmsh_note "on (GPL)")
endif()
message(STATUS "Suture is BSD-3-Clause. Linked under the GPL: CHOLMOD's supernodal module, SuiteSparseQR; Gmsh: ${gmsh_note}, -DSUTURE_GMSH=OFF leaves it out.")
