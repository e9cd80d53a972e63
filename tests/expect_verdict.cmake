# Runs a script of this folder, with the definitions behind `expected`, and fails unless it takes
# `subject` for good, where `expected` is empty, or ends with an error that matches it.
function(expect_verdict script subject expected)
  execute_process(COMMAND ${CMAKE_COMMAND} ${ARGN} -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${script}
    RESULT_VARIABLE code ERROR_VARIABLE errors OUTPUT_QUIET)
  string(REGEX REPLACE "[ \n]+" " " errors "${errors}")
  if(expected STREQUAL "" AND NOT code EQUAL 0)
    message(SEND_ERROR "${subject}: must be good, got: ${errors}")
  elseif(NOT expected STREQUAL "" AND (code EQUAL 0 OR NOT errors MATCHES "${expected}"))
    message(SEND_ERROR "${subject}: must be wrong (${expected}), got: ${errors}")
  endif()
endfunction()
