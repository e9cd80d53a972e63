#!/usr/bin/env bash
# No installed file may hold a path of the source tree, of the build, or of the place where it was
# installed first: relocatable.sh SOURCE BUILD PREFIX
set -euo pipefail
prefix=$3
status=0
for path in "$1" "$2" "$prefix-before"; do
  if found=$(grep -rlaF -e "$path/" "$prefix"); then
    echo "the path $path is in"
    echo "$found"
    status=1
  fi
done
for needed in bin/hamjet include/hamjet/version.hpp include/hamjet/instruction_set.hpp \
  include/hamjet/maps/exactness.hpp share/hamjet/scenes/paper/earth-orbit.toml \
  share/hamjet/examples/two-satellites/two-satellites.toml share/hamjet/gravity/EGM96-zonals.gfc \
  share/bash-completion/completions/hamjet; do
  [ -e "$prefix/$needed" ] || { echo "not installed: $needed"; status=1; }
done
exit $status
