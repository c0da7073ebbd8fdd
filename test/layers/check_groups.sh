#!/bin/sh
# check_groups.sh LIST: each line of the file LIST is "program group,group,... source", one of suture_test(). Prints, and fails for, a source
# with a test of another group, which ctest would not run, a group without a test in its source, and a group that two sources of a program share.
awk '
  function wrong(what) { print what; bad = 1 }

  NF == 0 { next }

  {
    ++count
    source = $0
    sub(/^[^ ]* [^ ]* /, "", source)
    split("", found)
    while ((getline line < source) > 0)
      if (match(line, /^ *TEUCHOS_UNIT_TEST *\( *[A-Za-z0-9_]+/)) {
        group = substr(line, RSTART, RLENGTH)
        sub(/.*[( ]/, "", group)
        found[group] = 1
      }
    close(source)
    n = split($2, groups, ",")
    split("", given)
    for (i = 1; i <= n; ++i) {
      given[groups[i]] = 1
      if (!(groups[i] in found)) wrong(source ": no test of the group " groups[i])
      if (seen[$1, groups[i]]++) wrong($1 ": two sources have the group " groups[i])
    }
    for (group in found)
      if (!(group in given)) wrong(source ": tests of " group " are not run: suture_test(... GROUPS " group ")")
  }

  END {
    if (count == 0) wrong("no tests in " FILENAME)
    exit bad
  }
' "$1"
