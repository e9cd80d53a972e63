#!/bin/sh
# Compares what the command says now with what stands here: compare.sh TOOL PROGRAM FOLDER.
set -eu
command -v python3 >/dev/null || exit 77
"$1" words "$2" "$3/words"
"$1" compare --exact "$(dirname "$0")/words" "$3/words"
