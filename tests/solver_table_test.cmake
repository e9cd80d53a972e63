# solver_table.cmake sees a row that is not true of the files and a solver that stands in no row. In
# DIRECTORY.
include(${CMAKE_CURRENT_LIST_DIR}/expect_verdict.cmake)
set(tree ${DIRECTORY}/tree)
file(REMOVE_RECURSE ${tree})
file(WRITE ${tree}/src/search/root.hpp "root_between(")
file(WRITE ${tree}/src/plain.cpp "int main() {}")
file(WRITE ${tree}/tests/a_test.cpp "TEST(Search, Fails) {}\nTEST_F(Other,\n  Fails) {}")

function(expect rows expected)
  file(WRITE ${tree}/tests/README.md "# Page\n\n## Solvers, and who sees that they fail\n\nWords.\n\n"
    "| solver | where | when | who | test |\n|---|---|---|---|---|\n${rows}\n\n## Next\n\n| a | b |\n")
  expect_verdict(solver_table.cmake "${rows}" "${expected}" -DSOURCE_DIR=${tree})
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
