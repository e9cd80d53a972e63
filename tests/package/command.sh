#!/usr/bin/env bash
# The installed command finds its data wherever it was moved to: command.sh PREFIX VERSION
set -euo pipefail
prefix=$1
version=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

said=$("$prefix/bin/hamjet" --version)
[ "$said" = "hamjet $version" ] || { echo "--version: $said"; exit 1; }

# One case in place of the suite, so that this takes no minute; it is found through a link too.
mkdir -p moved/bin moved/share/hamjet/scenes/extreme
cp "$prefix/bin/hamjet" moved/bin/
cp "$prefix/share/hamjet/scenes/extreme/oscillator-1.toml" moved/share/hamjet/scenes/extreme/
ln -s moved/bin/hamjet linked
for program in moved/bin/hamjet ./linked; do
  "$program" stability --json -o results >cases.json
  grep -q '"oscillator-1"' cases.json || { echo "$program: the suite was not run"; exit 1; }
done

# And says so where there is none.
rm -r moved/share
if moved/bin/hamjet stability 2>message; then
  echo "a suite was found where there is none"
  exit 1
fi
grep -q 'data/scenes/extreme: no such folder' message || { cat message; exit 1; }
