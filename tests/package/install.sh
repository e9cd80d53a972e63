#!/usr/bin/env bash
# Installs a build, then moves what was installed, so that whatever has kept the prefix fails:
# install.sh BUILD PREFIX
set -euo pipefail
build=$1
prefix=$2
rm -rf "$prefix" "$prefix-before"
cmake --install "$build" --prefix "$prefix-before" >/dev/null
mv "$prefix-before" "$prefix"
