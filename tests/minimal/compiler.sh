#!/bin/sh
# The compiler, which takes over an object of the build in $HAMJET_OTHER_BUILD instead of compiling
# the same file once more with the same definitions and for the same instruction set. What it takes
# is noted in the file taken-over: compiler.sh COMPILER ARGUMENT...
set -eu
object=
depfile=
source=
before=
for argument in "$@"; do
  case $before in
    -o) object=$argument ;;
    -MF) depfile=$argument ;;
    -c) source=$argument ;;
  esac
  before=$argument
done

# The options that change what is compiled, from a command line with a word on each line.
relevant() { tr -d '\\"' | grep '^-[Dm]' | sort -u; }

other=${HAMJET_OTHER_BUILD:-}

# A file that the build has generated must be the same in both, but for where it lies.
is_same_source() {
  case $source in
    "$PWD"/*) sed "s#$PWD#$other#g" "$source" | cmp -s - "$other${source#"$PWD"}" ;;
  esac
}

if [ -n "$other" ] && [ -n "$depfile" ] && [ -f "$other/$object" ] && is_same_source; then
  here=$(printf '%s\n' "$@" | relevant || true)
  there=$(grep -F -e " -o $object -c " "$other/compile_commands.json" | tr ' ' '\n' | relevant ||
    true)
  if [ "$here" = "$there" ]; then
    cp "$other/$object" "$object"
    printf '%s:\n' "$object" >"$depfile"
    printf '%s\n' "$object" >>taken-over
    exit 0
  fi
fi
exec "$@"
