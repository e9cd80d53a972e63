#!/usr/bin/env bash
# The completion as bash asks for it: completion.sh SCRIPT PROGRAM
set -uo pipefail # without -e, as in an interactive shell
script=$1
program=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
mkdir -p scenes out/scene/gauss8 out/scene/midpoint out/scene/no-result
touch orbit.toml other.toml orbit.csv out/scene/{gauss8,midpoint}/jet.csv
failures=0

# shellcheck source=/dev/null
source "$script" || exit 1
complete -p hamjet | grep -qF -- '-F _hamjet' || { echo "nothing completes hamjet"; exit 1; }

# expect ANSWERS WORD...: what the last of the words, cut as bash does, is completed to.
expect() {
  COMP_WORDS=("${@:2}")
  COMP_CWORD=$(($# - 2))
  COMPREPLY=()
  _hamjet
  local answers
  answers=$(printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' ')
  if [ "$answers" != "$1" ]; then
    printf '%s\n  is completed to  %s\n  in place of      %s\n' "${*:2}" "$answers" "$1"
    failures=$((failures + 1))
  fi
}

commands=$("$program" --help | sed -n '/^Subcommands:/,$ s/^  \([a-z][a-z-]*\) .*/\1/p' |
  sort | paste -sd ' ')
[ "$(wc -w <<<"$commands")" -ge 11 ] || { echo "only these commands: $commands"; exit 1; }
expect "$commands" hamjet ''
expect "$(tr ' ' '\n' <<<"$commands" | grep '^c' | paste -sd ' ')" hamjet c
expect '--help --version' hamjet --
# Options are those that --help prints, and their short names.
for command in $commands; do
  options=$("$program" "$command" --help | sed -n 's/^  \(-[-a-z_,]*\).*/\1/p' | tr , '\n' |
    sort | paste -sd ' ')
  expect "$options" hamjet "$command" -
done
# Scenes, and folders that may hold some.
expect 'orbit.toml other.toml out scenes' hamjet run ''
expect 'orbit.toml' hamjet run or
expect 'orbit.toml' hamjet run --json -o results --set jet.order = 6 or
expect '' hamjet run orbit.toml ''
expect 'out scenes' hamjet run orbit.toml -o ''
expect 'out' hamjet run orbit.toml --output = o
expect '' hamjet run orbit.toml --set ''
expect 'orbit.csv orbit.toml' hamjet eval out/scene --deviations orb
# Enumerated values, with and without the equals sign.
expect 'pdf png' hamjet compare orbit.toml --plots ''
expect 'pdf' hamjet compare orbit.toml --plots pd
expect 'pdf png' hamjet compare orbit.toml --plots =
expect 'pdf' hamjet compare orbit.toml --plots = pd
expect 'columns integrators keys kinds systems' hamjet list ''
expect 'geo gto leo molniya own pair zonal' hamjet init ''
expect "$commands" hamjet help ''
expect 'RTN canonical curvilinear element-differences inertial relative-elements' hamjet eval out/scene --frame ''
# Runs of a folder of results that have a jet.
expect 'gauss8 midpoint' hamjet eval out/scene --run ''
expect 'gauss8' hamjet transfer orbit.toml --jet out/scene/ --run g
expect '' hamjet eval --run ''
expect '' hamjet nonsense ''
[ $failures -eq 0 ]
