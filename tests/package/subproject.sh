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
for option in NATIVE TESTS WERROR INSTALL COMMAND CVODE; do
  [ "$(cached "HAMJET_$option")" = OFF ] || fail "HAMJET_$option is $(cached "HAMJET_$option")"
done
grep -q 'FLAGS = .*-Wall' "$build/build.ninja" || fail "the flags were not seen"
for flag in -Werror -march=native; do
  ! grep -q -e "$flag" "$build/build.ninja" || fail "compiles with $flag"
done
for entry in HELP2MAN CLI11_DIR CMAKE_INSTALL_BINDIR; do
  ! grep -q "^$entry:" "$build/CMakeCache.txt" || fail "$entry is in the cache"
done
program=$(sed -n '/^build CMakeFiles\/program.dir\/program.cpp.o:/,/^$/p' "$build/build.ninja")
grep -q 'FLAGS = ' <<<"$program" || fail "the program's flags were not seen"
! grep -q -e -ffp-contract <<<"$program" || fail "the program is compiled with -ffp-contract"
cmake --install "$build" --prefix "$build/installed" >/dev/null
[ ! -e "$build/installed" ] || fail "installs $(find "$build/installed" -type f | head -n 3)"
ctest --test-dir "$build" --show-only | grep -q '^Total Tests: 0$' || fail "has tests"
