# cmake -DPROGRAM=... -DOUTPUT=... -P DiscoverVerify.cmake
# Asks the program for its verification cases and writes a ctest file: one test a case, label verify; validate
# for a case that `verify --list` marks as too long for every run.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${PROGRAM} verify --list
  OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} verify --list ended with ${status}:\n${text}")
endif()
string(REGEX REPLACE "[][;]" " " text "${text}") # what CMake lists read as their own
string(REGEX MATCHALL "[^\n]+" lines "${text}")
set(script "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([A-Za-z0-9_.-]+)([ \t]|$)")
    continue()
  endif()
  set(name ${CMAKE_MATCH_1})
  set(label verify)
  if(line MATCHES "\\(by name or --all\\)$")
    set(label validate)
  endif()
  string(APPEND script
    "add_test([=[verify.${name}]=] [=[${PROGRAM}]=] verify ${name})\n"
    "set_tests_properties([=[verify.${name}]=] PROPERTIES LABELS ${label} TIMEOUT ${TIMEOUT})\n")
endforeach()
if(NOT script)
  message(FATAL_ERROR "${PROGRAM} verify --list names no case:\n${text}")
endif()
file(WRITE ${OUTPUT} "${script}")
