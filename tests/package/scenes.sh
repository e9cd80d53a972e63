#!/usr/bin/env bash
# Every installed scene is good where it was installed to: scenes.sh PREFIX. A case of the stability
# suite may be refused, but not because a file that it names is missing; a study of a sweep is no scene.
set -euo pipefail
prefix=$1
scenes=$prefix/share/hamjet/scenes
examples=$prefix/share/hamjet/examples
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
input_output=5
without_cvode=
"$prefix/bin/hamjet" list integrators | grep -q 'cvode.*not built' && without_cvode=yes
count=0
failed=0
while read -r scene; do
  grep -q '^\[sweep\]' "$scene" && continue
  count=$((count + 1))
  status=0
  "$prefix/bin/hamjet" check "$scene" >said 2>&1 || status=$?
  if [ $status -eq 0 ]; then continue; fi
  if grep -q '^\[case\]' "$scene" && [ $status -ne $input_output ]; then continue; fi
  if [ -n "$without_cvode" ] && grep -q 'no CVODE' said; then continue; fi
  echo "$scene: exit code $status: $(tail -1 said)"
  failed=$((failed + 1))
done < <(find "$scenes" "$examples" -name '*.toml' | sort)
[ $count -ge 150 ] || { echo "only $count scenes in $scenes"; exit 1; }
[ $failed -eq 0 ]
