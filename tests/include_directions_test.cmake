# include_directions.cmake sees every way in which a file can include one of a layer above its own,
# and takes includes downward, within a layer and of other libraries for good. In DIRECTORY.
include(${CMAKE_CURRENT_LIST_DIR}/expect_verdict.cmake)
set(tree ${DIRECTORY}/tree)
file(REMOVE_RECURSE ${tree})
foreach(file include/hamjet/error.hpp include/hamjet/maps/exactness.hpp src/maps/order.hpp
    src/report/text.hpp src/cli/options.hpp src/python/arrays.hpp)
  file(WRITE ${tree}/${file} "")
endforeach()

function(expect file line expected)
  file(WRITE ${tree}/${file} "// A comment of #include \"nothing.hpp\"\n${line}\n")
  expect_verdict(include_directions.cmake "${file}: ${line}" "${expected}" -DSOURCE_DIR=${tree}
    -DGENERATED=)
  file(REMOVE ${tree}/${file})
endfunction()

expect(include/hamjet/algebra/a.hpp "#include \"hamjet/maps/exactness.hpp\"" "includes upward")
expect(include/hamjet/algebra/a.hpp "#include <hamjet/maps/exactness.hpp>" "includes upward")
expect(src/algebra/a.cpp "#include \"../maps/order.hpp\"" "includes upward")
expect(src/algebra/a.cpp "  #  include \"order.hpp\"" "includes upward")
expect(src/studies/a.hpp "#include \"../report/text.hpp\"" "includes upward")
expect(src/report/deep/a.cpp.in "#include \"../../cli/options.hpp\"" "includes upward")
expect(src/cli/a.cpp "#include \"../python/arrays.hpp\"" "includes upward")
expect(src/cli/a.cpp "#include \"../cli/absent.hpp\"" "not found")
expect(src/python/a.cpp "#include \"../cli/options.hpp\"" "")
expect(src/python/a.cpp "#include \"arrays.hpp\"" "")
expect(src/report/a.cpp "#include \"../maps/order.hpp\"\n#include <vector>" "")
expect(src/algebra/a.cpp "#include \"hamjet/error.hpp\"" "")
# Last, for the folder stays.
expect(src/extra/a.cpp "" "src/extra is no layer")
