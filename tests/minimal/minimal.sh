#!/usr/bin/env bash
# Configures and builds hamjet with everything optional switched off, and all that is optional not
# to be found, and shows that the result needs nothing but what the main job needs: the headers that
# were read, the libraries that the program loads, and a scene that it runs.
#
# minimal.sh SOURCE FOLDER [OTHER-BUILD [OPTION ...]]
#
# With another build, whose options are repeated, the objects are its own wherever they are compiled
# in the same way (see compiler.sh), which takes seconds in place of minutes. Without it all is
# compiled: tests/minimal/minimal.sh . build-minimal
set -euo pipefail
source=$(cd "$1" && pwd)
folder=$2
other=${3:-}
options=("${@:4}")
fail() {
  echo "minimal: $*"
  exit 1
}

for package in SUNDIALS HDF5 pugixml TBB Python Python3 PythonInterp PythonLibs pybind11 GTest rapidcheck \
  benchmark MPI OpenMP; do
  options+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
for option in CVODE HDF5 XML PYTHON TESTS BENCHMARKS; do
  options+=("-DHAMJET_$option=OFF")
done
if [ -n "$other" ]; then
  export HAMJET_OTHER_BUILD=$other
  options+=("-DCMAKE_CXX_COMPILER_LAUNCHER=$source/tests/minimal/compiler.sh"
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON)
fi
rm -rf "$folder"
cmake --no-warn-unused-cli -S "$source" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DHELP2MAN=OFF \
  "${options[@]}" >/dev/null
cd "$folder"
touch taken-over
ninja >log || { cat log; fail "the build failed"; }

# Headers, by what each object of the program was compiled from, here or in the other build.
objects=$(find . -name '*.o' -o -name '*.gch' | sed 's#^\./##' | sort)
count=$(wc -l <<<"$objects")
[ "$count" -gt 30 ] || fail "only $count objects"
headers=$({
  ninja -t deps
  [ -z "$other" ] || ninja -C "$other" -t deps
} | awk -v objects="$objects" '
  BEGIN { count = split(objects, list, "\n"); for (i in list) own[list[i]] = 1
          own["src/CMakeFiles/precompiled_headers.dir/cmake_pch.hxx.gch"] = 1
          own["src/CMakeFiles/precompiled_shell_headers.dir/cmake_pch.hxx.gch"] = 1 }
  /^[^ ].*: #deps/ { taken = sub(/: #deps.*/, "") && ($0 in own) }
  /^ / && taken { sub(/^ */, ""); print }' | sort -u)
[ "$(grep -c '^/usr/include/c++/' <<<"$headers")" -gt 100 ] || fail "the headers were not seen"
system=$(grep '^/usr/' <<<"$headers" | grep -vE \
  -e '^/usr/lib/gcc/' \
  -e '^/usr/include/(c\+\+|eigen3|boost|fmt|toml\+\+|nlohmann|CLI|coin|linux|asm-generic)/' \
  -e '^/usr/include/[a-z0-9_]+-linux-gnu/(asm|bits|c\+\+|gnu|sys)/' \
  -e '^/usr/include/[a-z0-9_-]+\.h$' || true)
[ -z "$system" ] || fail "these headers are of something optional:"$'\n'"$system"

# Libraries.
libraries=$(readelf -d hamjet | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
others=$(grep -vE '^(lib(fmt|tomlplusplus|Clp|erfa|quadmath|stdc\+\+|m|gcc_s|c|asan|ubsan)\.so|ld-linux)' \
  <<<"$libraries" || true)
[ -z "$others" ] || fail "the program loads something optional: $others"

# The program, which knows what it has not got.
./hamjet list integrators >integrators
grep -q 'cvode-adams.*NOT BUILT' integrators || fail "CVODE is there: $(cat integrators)"
cat >orbit.toml <<'SCENE'
schema = 1
title = "small"
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
a_km = 10000
e = 0.1
i_deg = 30
raan_deg = 10
argp_deg = 20
ta_deg = 30
[jet]
order = 2
duration_canonical = 1
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = 1e-13
require_symplecticity = 1e-13
[generating_function]
kinds = ["F1"]
SCENE
./hamjet run orbit.toml -q -o results
[ -s results/gauss8/generating_function_F1.csv ] || fail "no generating function"
echo "$count objects, $(wc -l <taken-over) of them from the other build;" \
  "loads $(tr '\n' ' ' <<<"$libraries")"
