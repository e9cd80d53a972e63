# Writes a test of ctest for every suite of a test program, whose tests run in one process:
# cmake -DLAYER=maps -DPROGRAM=FILE -DRUNNER=run_suite.sh -DOUTPUT=FILE -P list_suites.cmake
# The test is LAYER.SUITE; a suite whose name ends in AtLength has the label long, and begins first.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE lines
  COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." lines "${lines}")
set(suites)
foreach(line ${lines})
  string(REGEX REPLACE "\n|\\.$" "" instance ${line})
  # A suite of typed tests is listed once for each type, as SUITE/0, SUITE/1 and so on.
  string(REGEX REPLACE "/[0-9]+$" "" suite ${instance})
  list(APPEND suites ${suite})
  list(APPEND filter_${suite} ${instance}.*)
endforeach()
list(REMOVE_DUPLICATES suites)
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} has no tests")
endif()

set(script)
foreach(suite ${suites})
  list(JOIN filter_${suite} ":" filter)
  set(properties "TIMEOUT 1800 SKIP_RETURN_CODE 77")
  if(suite MATCHES "AtLength$")
    string(APPEND properties " LABELS long COST 200")
  endif()
  string(APPEND script "add_test([[${LAYER}.${suite}]] [[${RUNNER}]] [[${PROGRAM}]] [[${filter}]])\n"
    "set_tests_properties([[${LAYER}.${suite}]] PROPERTIES ${properties})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
