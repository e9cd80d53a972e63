# include_directions.cmake sees every way in which a file can include one of a layer above its own,
# and takes includes downward, within a layer and of other libraries for good. In DIRECTORY.
set(tree ${DIRECTORY}/tree)
file(REMOVE_RECURSE ${tree})
foreach(file include/hamjet/error.hpp include/hamjet/maps/exactness.hpp src/maps/order.hpp
    src/report/text.hpp src/cli/options.hpp src/python/arrays.hpp)
  file(WRITE ${tree}/${file} "")
endforeach()

function(expect file line expected)
  file(WRITE ${tree}/${file} "// A comment of #include \"nothing.hpp\"\n${line}\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${tree} -DGENERATED=
      -P ${CMAKE_CURRENT_LIST_DIR}/include_directions.cmake
    RESULT_VARIABLE code ERROR_VARIABLE errors OUTPUT_QUIET)
  file(REMOVE ${tree}/${file})
  string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
  if(expected STREQUAL "" AND NOT code EQUAL 0)
    message(SEND_ERROR "${file}: ${line}: must be good, got: ${errors}")
  elseif(NOT expected STREQUAL "" AND (code EQUAL 0 OR NOT errors MATCHES "${expected}"))
    message(SEND_ERROR "${file}: ${line}: must be wrong (${expected}), got: ${errors}")
  endif()
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
