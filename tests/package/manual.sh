#!/usr/bin/env bash
# The manual's pages render without a warning, and name every command, its options, and the exit
# codes: manual.sh PREFIX
set -euo pipefail
prefix=$1
pages=$prefix/share/man/man1
program=$prefix/bin/hamjet
status=0
# render PAGE WIDTH
render() { groff -ww -man -Tutf8 -P-cbou -rLL="$2"n "$1"; }

for page in "$pages"/*.1; do
  warnings=$(render "$page" 80 2>&1 >/dev/null)
  [ -z "$warnings" ] || { echo "$page: $warnings"; status=1; }
done

# expect PAGE WORD...
expect() {
  local text
  text=$(render "$pages/$1.1" 5000) # no word is cut at a line's end
  for word in "${@:2}"; do
    grep -qFe "$word" <<<"$text" || { echo "$1.1 does not say $word"; status=1; }
  done
}
expect hamjet 'Exit codes' '0 all well' '1 a check failed' '2 usage' '3 scene' \
  '4 numerical failure' '5 input or output' '6 refused' '129, 130, 131 or 143 interrupted'
commands=$("$program" completion bash | sed -n "s/^    '') commands='\([^']*\)'.*/\1/p")
[ "$(wc -w <<<"$commands")" -ge 11 ] || { echo "only these commands: $commands"; status=1; }
for command in $commands; do
  expect hamjet "hamjet-$command(1)"
  mapfile -t options < <("$program" "$command" --help | grep -oE '^  (-[a-z],)?--[a-z-]+' |
    grep -oE -- '--[a-z-]+')
  expect "hamjet-$command" "hamjet $command" "${options[@]}"
done
exit $status
