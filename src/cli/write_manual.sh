#!/bin/sh
# Writes the manual, a page for the program and one for each of its commands, from what --help
# prints: write_manual.sh HELP2MAN PROGRAM VERSION FOLDER
set -eu
help2man=$1
program=$2
version=$3
folder=$4

rm -rf "$folder"
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# write_page NAME DESCRIPTION PROGRAM SEE-ALSO
write_page() {
  printf '[SEE ALSO]\n%s\n' "$4" >"$work/include"
  "$help2man" --no-info --name="$2" --version-string="$version" --source="hamjet $version" \
    --include="$work/include" --output="$folder/$1.1" "$3"
}

# Name and description, a line each; what a description goes on with is indented further.
"$program" --help | sed -n '/^Subcommands:/,$ s/^  \([a-z][a-z-]*\)  *\(.*\)/\1 \2/p' >"$work/list"
pages=
while read -r command description; do
  # help2man names the page after the program.
  printf '#!/bin/sh\nexec "%s" %s "$@"\n' "$program" "$command" >"$work/hamjet-$command"
  chmod +x "$work/hamjet-$command"
  write_page "hamjet-$command" "$description" "$work/hamjet-$command" ".BR hamjet (1)"
  pages="$pages${pages:+,
}.BR hamjet-$command (1)"
done <"$work/list"
write_page hamjet "Taylor maps and generating functions of Hamiltonian flows" "$program" "$pages"
