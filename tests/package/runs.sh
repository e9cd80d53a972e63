#!/usr/bin/env bash
# Installed scenes and the files that they name run from any working directory, and leave their
# results there alone: runs.sh PREFIX
set -euo pipefail
prefix=$1
data=$prefix/share/hamjet
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/of a person"
cd "$work/of a person"
touch before
runs="scenes/earth-orbit-j6 scenes/orbit-messages examples/two-satellites/two-satellites"
if "$prefix/bin/hamjet" list integrators | grep -q 'cvode.*not built'; then
  echo "without CVODE the paper's orbit is not run"
else
  runs="scenes/paper/earth-orbit $runs"
fi
for scene in $runs; do
  "$prefix/bin/hamjet" run -q "$data/$scene.toml"
  [ -s "out/$(basename "$scene")/summary.json" ] || { echo "$scene: no results here"; exit 1; }
done
# A path that leads there from here.
cp -r "$data/examples" .
"$prefix/bin/hamjet" motion -q examples/two-satellites/two-satellites.toml
[ -s out/two-satellites-motion/motion.csv ] || { echo "no motion here"; exit 1; }
written=$(find "$prefix" -newer before -type f)
[ -z "$written" ] || { echo "written among what is installed: $written"; exit 1; }
