# Fails if one of OBJECTS defines a function in which numbers are added and multiplied, or one that
# belongs to the library or to the command: their sources are compiled once, elsewhere.
list(FILTER OBJECTS EXCLUDE REGEX "\\.gch$")  # precompiled headers are no objects
execute_process(COMMAND ${NM} --demangle --defined-only ${OBJECTS} OUTPUT_VARIABLE symbols
  COMMAND_ERROR_IS_FATAL ANY)
set(arithmetic "(Eigen::internal::(general|gebp|partial_lu|triangular)|hamjet::detail::)")
string(REGEX MATCHALL "[^\n]* [WVTt] [^\n]*${arithmetic}[^\n]*" found "${symbols}")
# Weak symbols (W) are inline functions of the headers, which the module may have.
string(REGEX MATCHALL "[^\n]* T hamjet::[^\n]*" own "${symbols}")
list(FILTER own EXCLUDE REGEX " T hamjet::python::")
list(APPEND found ${own})
if(found)
  list(TRANSFORM found REPLACE "^[0-9a-f]* " "")
  list(JOIN found "\n  " lines)
  message(FATAL_ERROR "the module computes on its own:\n  ${lines}")
endif()
