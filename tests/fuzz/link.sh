#!/bin/sh
# Compiles all fuzz targets with clang and links them with an installed library and libFuzzer:
# link.sh FUZZ-PROJECT PREFIX FOLDER. Exit code 77 where clang or its libFuzzer is not installed.
set -eu
command -v clang++ >/dev/null || exit 77
mkdir -p "$3"
printf 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }\n' >"$3/probe.cpp"
clang++ -fsanitize=fuzzer "$3/probe.cpp" -o "$3/probe" 2>/dev/null || exit 77
cmake -S "$1" -B "$3/build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DHAMJET_FUZZ_INSTALLED=ON \
  -DCMAKE_PREFIX_PATH="$2" >/dev/null
cmake --build "$3/build"
while read -r target rest; do
  "$3/build/$target" -help=1 >/dev/null 2>&1 </dev/null || { echo "$target does not start"; exit 1; }
done <"$1/targets"
