#!/bin/sh
# Builds and links all fuzz targets with clang, without instrumentation: link.sh FUZZ-PROJECT FOLDER.
# Exit code 77 where clang or its libFuzzer is not installed.
set -eu
command -v clang++ >/dev/null || exit 77
mkdir -p "$2"
printf 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }\n' >"$2/probe.cpp"
clang++ -fsanitize=fuzzer "$2/probe.cpp" -o "$2/probe" 2>/dev/null || exit 77
cmake -S "$1" -B "$2/build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DHAMJET_FUZZ_SANITIZERS= >/dev/null
cmake --build "$2/build"
while read -r target rest; do
  "$2/build/$target" -help=1 >/dev/null 2>&1 </dev/null || { echo "$target does not start"; exit 1; }
done <"$1/targets"
