#!/bin/sh
# planted_groups.sh CHECK FOLDER: the check must pass a correct list and fail for each error planted in it.
check=$1
tree=$2
failed=0
rm -rf "$tree"
mkdir -p "$tree"
printf '%s\n' 'TEUCHOS_UNIT_TEST(A, IsTrue) {' '}' 'TEUCHOS_UNIT_TEST(Other, IsTrue) {' >"$tree/A.cpp"
printf '%s\n' 'TEUCHOS_UNIT_TEST(B, IsTrue) {' >"$tree/B.cpp"

# expect CODE WORDS LINES...: the check of LINES exits with CODE and prints WORDS.
expect() {
  code=$1
  words=$2
  shift 2
  printf '%s\n' "$@" >"$tree/list"
  said=$(sh "$check" "$tree/list")
  got=$?
  case $said in *"$words"*) ;; *) got=none ;; esac
  [ "$got" = "$code" ] || {
    echo "expected $code and '$words', got $got and '$said' for: $*"
    failed=1
  }
}

expect 0 '' "one A,Other $tree/A.cpp" "one B $tree/B.cpp"
expect 1 'tests of Other are not run' "one A $tree/A.cpp"
expect 1 'no test of the group C' "one B,C $tree/B.cpp"
expect 1 'one: two sources have the group B' "one A,Other $tree/A.cpp" "one B $tree/B.cpp" "one B $tree/B.cpp"
expect 0 '' "one B $tree/B.cpp" "two B $tree/B.cpp"
expect 1 'no tests' ''
rm -rf "$tree"
exit $failed
