#!/usr/bin/env bash
# Within another project hamjet leaves that project's build type, warnings, instruction set,
# installation and tests alone; nothing is compiled: subproject.sh SOURCE BUILD [OPTION ...]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source=$1
build=$2
fail() {
  echo "subproject: $*"
  exit 1
}

rm -rf "$build"
cmake -G Ninja -S "$here/subproject" -B "$build" -DHAMJET_SOURCE="$source" "${@:3}" >/dev/null

cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
[ -z "$(cached CMAKE_BUILD_TYPE)" ] || fail "the build type became $(cached CMAKE_BUILD_TYPE)"
for option in NATIVE TESTS WERROR INSTALL; do
  [ "$(cached "HAMJET_$option")" = OFF ] || fail "HAMJET_$option is $(cached "HAMJET_$option")"
done
grep -q 'FLAGS = .*-Wall' "$build/build.ninja" || fail "the flags were not seen"
for flag in -Werror -march=native; do
  ! grep -q -e "$flag" "$build/build.ninja" || fail "compiles with $flag"
done
cmake --install "$build" --prefix "$build/installed" >/dev/null
[ ! -e "$build/installed" ] || fail "installs $(find "$build/installed" -type f | head -n 3)"
ctest --test-dir "$build" --show-only | grep -q '^Total Tests: 0$' || fail "has tests"
