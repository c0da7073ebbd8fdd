#!/bin/sh
# planted.sh CHECK FOLDER: the check must pass a clean tree and fail for each violation planted in it, one at a time.
check=$1
tree=$2
failed=0

clean() {
  rm -rf "$tree"
  mkdir -p "$tree/packages/base" "$tree/packages/mesh" "$tree/packages/report"
  # Harmless lines that look like the forbidden ones.
  printf '%s\n' '#pragma once' '// MPI_COMM_WORLD, std::cout, exit(1) and using namespace std are for drivers' 'int onexit(int);' 'int snprintf(int);' \
    'int signals(int);' >"$tree/packages/base/A.hpp"
  printf '%s\n' '#include <suture/base/A.hpp>' '#include "B.hpp"' 'using namespace std;' >"$tree/packages/mesh/B.cpp"
  printf '%s\n' '#include <suture/mesh/B.hpp>' '#include <suture/report/C.hpp>' >"$tree/packages/report/C.cpp"
}

# expect FILE LINE: with LINE in FILE the check fails and prints LINE.
expect() {
  clean
  printf '%s\n' "$2" >>"$tree/packages/$1"
  said=$(sh "$check" "$tree" base mesh report) && {
    echo "not caught in $1: $2"
    failed=1
    return
  }
  case $said in
    "packages/$1:"*"$2"*) ;;
    *)
      echo "caught in $1, but not shown: $2"
      echo "$said"
      failed=1
      ;;
  esac
}

clean
sh "$check" "$tree" base mesh report || {
  echo "a clean tree does not pass"
  failed=1
}
expect base/A.hpp '#include <suture/mesh/B.hpp>'
expect mesh/B.cpp '  #  include <suture/report/C.hpp>'
expect mesh/B.cpp '#include <suture/nosuch/C.hpp>'
expect mesh/B.cpp '#include "../report/C.hpp"'
expect mesh/B.cpp 'MPI_Barrier(MPI_COMM_WORLD);'
expect mesh/B.cpp '  std::cout << 1;'
expect mesh/B.cpp '  std::cerr << 1;'
expect mesh/B.cpp 'printf("x");'
expect mesh/B.cpp '  if (x) std::exit(1);'
expect mesh/B.cpp 'abort();'
expect mesh/B.cpp 'MPI_Abort(comm, 1);'
expect mesh/B.cpp 'std::signal(SIGTERM, f);'
expect base/A.hpp 'using namespace std;'
expect base/A.hpp '#include <hdf5.h>'
expect base/A.hpp '#include <BelosPseudoBlockCGIter.hpp>'
rm -rf "$tree"
exit $failed
