#!/bin/sh
# check_layers.sh ROOT PACKAGE...: reads the sources under ROOT/packages and prints, and fails for, every line that breaks the
# layering: a package that includes one to its right in the list PACKAGE..., or a call that the library must not make. Comments are ignored.
root=$1
shift
cd "$root" || exit 1
if [ -z "$(find packages -name '*.hpp')" ]; then
  echo "no headers under $root/packages"
  exit 1
fi
find packages \( -name '*.hpp' -o -name '*.cpp' \) | sort | xargs awk -v order="$*" '
  function wrong(what) { printf "%s:%d: %s\n    %s\n", FILENAME, FNR, what, $0; bad = 1 }

  BEGIN {
    count = split(order, names, " ")
    for (i = 1; i <= count; ++i) place[names[i]] = i
  }

  FNR == 1 {
    split(FILENAME, parts, "/")
    package = parts[2]
    isHeader = FILENAME ~ /\.hpp$/
    if (!(package in place)) wrong("the folder " package " is not in the list of packages")
  }

  { line = " " $0; sub(/\/\/.*/, "", line) }

  line ~ /^ *#[ \t]*include[ \t]*</ && match(line, /<suture\/[^\/>]*/) {
    included = substr(line, RSTART + 8, RLENGTH - 8)
    if (!(included in place)) wrong("there is no package " included)
    else if (place[included] > place[package]) wrong(package " includes " included ", which stands to its right")
  }
  line ~ /^ *#[ \t]*include[ \t]*"[^"]*\// { wrong("include another folder as <suture/package/X.hpp>: only then the order can be checked") }

  line ~ /MPI_COMM_WORLD/ { wrong("the library uses the communicator it is given") }
  line ~ /std::(cout|cerr|clog)/ || line ~ /[^A-Za-z0-9_](printf|puts)[ ]*\(/ || line ~ /fprintf[ ]*\([ ]*(stdout|stderr)/ { wrong("the library prints only to a stream it is given") }
  line ~ /[^A-Za-z0-9_](exit|_exit|_Exit|quick_exit|abort|MPI_Abort)[ ]*\(/ { wrong("the library throws; only drivers end the program") }
  line ~ /[^A-Za-z0-9_](signal|sigaction)[ ]*\(/ { wrong("signal handlers belong to the program") }

  isHeader && line ~ /using[ \t]+namespace/ { wrong("no using namespace in a header") }
  isHeader && line ~ /#[ \t]*include[ \t]*<(hdf5|gmsh|cholmod|metis|Amesos2|Belos|Intrepid2)[^_>]*(\.h|\.hpp|_[^>]*)>/ && line !~ /_fwd\.hpp/ { wrong("an expensive header belongs into the one source that needs it") }

  END { exit bad }
'
