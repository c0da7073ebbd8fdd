#!/bin/sh
# check_groups.sh LIST: each line of the file LIST is "program group,group,... source", one of suture_test(). Prints, and fails for, a source
# with a test of another group, which ctest would not run, a group without a test in its source, and a group that two sources of a program share.
bad=0
wrong() {
  echo "$1"
  bad=1
}
grep -q . "$1" || wrong "no tests in $1"
while read -r program groups source; do
  [ -n "$source" ] || continue
  found=$(sed -n 's/^ *TEUCHOS_UNIT_TEST *( *\([A-Za-z0-9_]*\).*/\1/p' "$source" | sort -u)
  for group in $found; do
    case ",$groups," in *",$group,"*) ;; *) wrong "$source: tests of $group are not run: suture_test(... GROUPS $group)" ;; esac
  done
  for group in $(echo "$groups" | tr ',' ' '); do
    echo "$found" | grep -qx "$group" || wrong "$source: no test of the group $group"
  done
done <"$1"
twice=$(awk '{ n = split($2, groups, ","); for (i = 1; i <= n; ++i) if (seen[$1, groups[i]]++) print $1 ": two sources have the group " groups[i] }' "$1")
[ -z "$twice" ] || wrong "$twice"
exit $bad
