# cmake -DPROGRAM=... -DOUTPUT=... -P DiscoverVerify.cmake
# Asks the program for its verification cases and writes a ctest file: one test a case, label verify.
# Cases that only `verify --list --hard` names get the label hard besides.
cmake_minimum_required(VERSION 3.25)

function(list_cases out)
  execute_process(COMMAND ${PROGRAM} verify --list ${ARGN}
    OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} verify --list ${ARGN} ended with ${status}:\n${text}")
  endif()
  string(REGEX REPLACE "[][;]" " " text "${text}") # what CMake lists read as their own
  string(REGEX MATCHALL "[^\n]+" lines "${text}")
  set(names)
  foreach(line IN LISTS lines)
    if(line MATCHES "^([A-Za-z0-9_.-]+)([ \t]|$)")
      list(APPEND names ${CMAKE_MATCH_1})
    endif()
  endforeach()
  if(NOT names)
    message(FATAL_ERROR "${PROGRAM} verify --list names no case:\n${text}")
  endif()
  set(${out} ${names} PARENT_SCOPE)
endfunction()

list_cases(usual)
list_cases(all --hard)
set(script "")
foreach(name IN LISTS all)
  set(labels "verify")
  if(NOT name IN_LIST usual)
    set(labels "verify;hard")
  endif()
  string(APPEND script
    "add_test([=[verify.${name}]=] [=[${PROGRAM}]=] verify ${name})\n"
    "set_tests_properties([=[verify.${name}]=] PROPERTIES LABELS [=[${labels}]=] TIMEOUT ${TIMEOUT})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
