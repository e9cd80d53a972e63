# solver_table.cmake sees a row that is not true of the files and a solver that stands in no row. In
# DIRECTORY.
set(tree ${DIRECTORY}/tree)
file(REMOVE_RECURSE ${tree})
file(WRITE ${tree}/src/search/root.hpp "root_between(")
file(WRITE ${tree}/src/plain.cpp "int main() {}")
file(WRITE ${tree}/tests/a_test.cpp "TEST(Search, Fails) {}\nTEST_F(Other,\n  Fails) {}")

function(expect rows expected)
  file(WRITE ${tree}/tests/README.md "# Page\n\n## Solvers, and who sees that they fail\n\nWords.\n\n"
    "| solver | where | when | who | test |\n|---|---|---|---|---|\n${rows}\n\n## Next\n\n| a | b |\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${tree}
      -P ${CMAKE_CURRENT_LIST_DIR}/solver_table.cmake
    RESULT_VARIABLE code ERROR_VARIABLE errors OUTPUT_QUIET)
  string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
  if(expected STREQUAL "" AND NOT code EQUAL 0)
    message(SEND_ERROR "must be good: ${rows}\ngot: ${errors}")
  elseif(NOT expected STREQUAL "" AND (code EQUAL 0 OR NOT errors MATCHES "${expected}"))
    message(SEND_ERROR "must be wrong (${expected}): ${rows}\ngot: ${errors}")
  endif()
endfunction()

expect("| root | `search/root.hpp` | error | main | `Search.Fails` |" "")
expect("| root | `search/` | error | main | `Other.Fails` |" "")
expect("| root | `search/root.hpp`, `plain.cpp` | error | main | cannot: by halves |" "")
expect("| root | `search/root.hpp` | error | main | cannot: |" "must name one test")
expect("| root | `search/root.hpp` | error | main | `Search.*` |" "must name one test")
expect("| root | `search/root.hpp` | error | main | `Search.Holds` |" "there is no test Search.Holds")
expect("| root | `search/roots.hpp` | error | main | `Search.Fails` |" "there is no src/search/roots.hpp")
expect("| root | `search/root.hpp` | error | `Search.Fails` |" "not five columns")
expect("| root | `plain.cpp` | error | main | `Search.Fails` |" "root.hpp: holds .* stands in no row")
