#!/bin/sh
# From a bare Debian 12 to a result in one command, from any folder and without a terminal:
#   sh cmake/bootstrap.sh run     install what is missing, build, solve the tunnel scene on two ranks and draw it
#   sh cmake/bootstrap.sh build   install what is missing and build library, programs and Python package into build/, as cmake --install needs
#   sh cmake/bootstrap.sh test    build and run all tests except those labelled long
#   sh cmake/bootstrap.sh validate  build, run all validation cases and 5,000 random scenes, write build/validation/validation.md; half an hour
#   sh cmake/bootstrap.sh doc     write the documentation as HTML into build/doc/html; compiles nothing
#   sh cmake/bootstrap.sh bench   build and measure against the monolithic reference; long (test/bench/README.md)
# The environment may set BUILD (another build folder) and JOBS (parallel compilations).
set -eu

usage() {
  echo "usage: sh cmake/bootstrap.sh run | build | test | validate | doc | bench" >&2
  exit 2
}
[ $# -eq 1 ] || usage
case $1 in run | build | test | validate | doc | bench) ;; *) usage ;; esac

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
cd "$root"
build=${BUILD:-build}

# Names in Debian 12. Trilinos' CMake configuration requires the components it was built with, and the libraries that they link.
packages="g++ cmake ninja-build ccache git pkg-config openmpi-bin libopenmpi-dev
  libtrilinos-tpetra-dev libtrilinos-belos-dev libtrilinos-amesos2-dev libtrilinos-teuchos-dev libtrilinos-kokkos-dev
  libtrilinos-kokkos-kernels-dev libtrilinos-trilinosss-dev libtrilinos-epetra-dev libtrilinos-epetraext-dev libtrilinos-triutils-dev
  libtrilinos-aztecoo-dev libtrilinos-xpetra-dev libtrilinos-thyra-dev libtrilinos-rtop-dev libtrilinos-shylu-dev
  libtrilinos-intrepid2-dev libtrilinos-shards-dev libtrilinos-sacado-dev libptscotch-dev libmumps-dev
  libmetis-dev libsuitesparse-dev libeigen3-dev libhdf5-openmpi-dev libgmsh-dev gmsh libopenblas-dev libcli11-dev nlohmann-json3-dev
  libmuparser-dev
  python3 python3-numpy python3-h5py python3-matplotlib python3-pil python3-vtk9 libjs-three
  python3-meshio python3-netcdf4 python3-jsonschema
  python3-dev pybind11-dev python3-mpi4py
  cmark-gfm python3-yaml dpkg-dev file"
[ "$1" != doc ] || packages="python3 cmark-gfm"

asRoot() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null 2>&1; then
    sudo "$@"
  else
    echo "bootstrap: neither root nor sudo; as root, run: apt-get install --no-install-recommends$missing" >&2
    exit 5
  fi
}

install() { asRoot env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@" </dev/null; }

# Without dpkg no packages are installed; CMake reports missing dependencies.
installMissing() {
  command -v dpkg-query >/dev/null 2>&1 || return 0
  # shellcheck disable=SC2086  # a list of words
  have=$(dpkg-query -W -f '${Package}=${db:Status-Status}\n' $packages 2>/dev/null || true)
  missing=
  for package in $packages; do
    printf '%s\n' "$have" | grep -qxF "$package=installed" || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  echo "bootstrap: installing$missing"
  # Package lists may be missing or outdated: fetch them only if absent or if the installation fails.
  # shellcheck disable=SC2086
  if ! apt-cache show libtrilinos-tpetra-dev >/dev/null 2>&1 || ! install $missing; then
    asRoot apt-get update -q </dev/null
    # shellcheck disable=SC2086
    install $missing
  fi
}

# getconf, because nproc obeys OMP_NUM_THREADS.
configureAndBuild() {
  # An existing build folder keeps its options.
  if [ -f "$build/CMakeCache.txt" ]; then
    cmake -S . -B "$build" </dev/null
  else
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSUTURE_UNITY=ON </dev/null
  fi
  cmake --build "$build" --parallel "${JOBS:-$(getconf _NPROCESSORS_ONLN)}" "$@" </dev/null
}

# Building the tests would double the time, and they are not needed here.
programs="--target suture_solve suture_study suture_partition_program suture_schema suture_new suture_plot_script suture_convert_script"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 # a container has no other user
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1                  # the ranks are the parallelism
export HWLOC_HIDE_ERRORS=2                                       # Open MPI complains where a chroot has no /sys

installMissing
# shellcheck disable=SC2086  # a list of words
case $1 in
  build) configureAndBuild --target suture_installed ;;
  run)
    configureAndBuild $programs
    out=$build/tunnel_out
    mpirun --oversubscribe -np 2 "$build/drivers/suture_solve" input/tunnel/tunnel.xml --output "$out" </dev/null
    "$build/drivers/suture_plot" "$out" </dev/null
    case $out in /*) ;; *) out=$root/$out ;; esac
    echo
    echo "The pictures of the run:"
    ls "$out"/*.png
    ;;
  test)
    configureAndBuild
    ctest --test-dir "$build" --output-on-failure -LE long --parallel "${JOBS:-$(getconf _NPROCESSORS_ONLN)}" </dev/null
    ;;
  validate)
    configureAndBuild $programs test_corpus
    /usr/bin/python3 -B test/validation/validate.py --solve "$build/drivers/suture_solve" --corpus "$build/bin/test_corpus" \
      --output "$build/validation" </dev/null
    ;;
  doc) /usr/bin/python3 -B doc/html/render.py "$build/doc/html" ;;
  bench)
    configureAndBuild $programs
    /usr/bin/python3 test/bench/bench.py --programs "$build/drivers" --output "$build/bench" </dev/null
    ;;
esac
