#!/bin/sh
# conda-build runs this script in a copy of the checkout.
set -eu
# shellcheck disable=SC2086  # a list of words
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DSUTURE_UNITY=ON -DSUTURE_TESTS=OFF -DSUTURE_PYTHON_PACKAGE=OFF -DCMAKE_INSTALL_LIBDIR=lib \
  -DCMAKE_INSTALL_PREFIX="$PREFIX" -DCMAKE_PREFIX_PATH="$PREFIX" ${CMAKE_ARGS:-}
cmake --build build --parallel "${CPU_COUNT:-1}"
cmake --install build
