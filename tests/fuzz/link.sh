#!/bin/sh
# Compiles fuzz targets, all of them or those that are named, with clang and links them with an
# installed library and libFuzzer: link.sh FUZZ-PROJECT PREFIX FOLDER [TARGET ...]. Exit code 77 where
# clang or its libFuzzer is not installed.
set -eu
command -v clang++ >/dev/null || exit 77
mkdir -p "$3"
printf 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }\n' >"$3/probe.cpp"
clang++ -fsanitize=fuzzer "$3/probe.cpp" -o "$3/probe" 2>/dev/null || exit 77
project=$1 prefix=$2 folder=$3
shift 3
[ $# -gt 0 ] || set -- $(sed 's/ .*//' "$project/targets")
cmake -S "$project" -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DHAMJET_FUZZ_INSTALLED=ON \
  -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$folder/build" --target "$@"
for target in "$@"; do
  "$folder/build/$target" -help=1 >/dev/null 2>&1 </dev/null || { echo "$target does not start"; exit 1; }
done
