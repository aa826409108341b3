# One ctest entry for each file of tests, so that its cases share a process and what it has loaded: on a CPU, starting
# OpenCL and reading its compiled kernels back takes longer than most cases.
#
# gtest_files(TARGET [QUICK ENTRY…] [SECONDS ENTRY=N…])
#   tests/FOLDER/NAME_test.cpp becomes the entry FOLDER.NAME with the label FOLDER. The program is asked for its cases
#   after each link, so the entries hold them all. QUICK: entries or folders that get the label `quick` as well.
#   SECONDS: what an entry takes, where that is long: ctest starts the longest first. It measures the others itself.
#
# The same file is the script that asks: -DPROGRAM, OUT, QUICK, SECONDS.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(gtest_files_script ${CMAKE_CURRENT_LIST_FILE})
  function(gtest_files target)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "QUICK;SECONDS")
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_entries.cmake)
    add_custom_command(
      TARGET ${target} POST_BUILD
      COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${target}> -DOUT=${out} "-DQUICK=${ARG_QUICK}"
              "-DSECONDS=${ARG_SECONDS}" -P ${gtest_files_script}
      VERBATIM)
    # A change of the script or its arguments asks again; so does a change of the program.
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${gtest_files_script})
    file(CONFIGURE OUTPUT ${target}_include.cmake @ONLY CONTENT
         "if(EXISTS \"@out@\")\n  include(\"@out@\")\nelse()\n  add_test(@target@_NOT_BUILT @target@_NOT_BUILT)\nendif()\n")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
  endfunction()
  return()
endif()

cmake_minimum_required(VERSION 3.25)
file(REMOVE ${OUT})
execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_output=json:${OUT}.json
                OUTPUT_QUIET TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
file(READ ${OUT}.json list)
file(REMOVE ${OUT}.json)

# entries, and of each: filter_ENTRY, cases_ENTRY.
set(entries "")
string(JSON suites LENGTH ${list} testsuites)
math(EXPR lastSuite "${suites} - 1")
foreach(s RANGE ${lastSuite})
  string(JSON suite GET ${list} testsuites ${s})
  string(JSON name GET ${suite} name)
  string(JSON count LENGTH ${suite} testsuite)
  math(EXPR last "${count} - 1")
  set(home "")
  foreach(c RANGE ${last})
    string(JSON file GET ${suite} testsuite ${c} file)
    if(NOT file MATCHES "([^/]+)/([^/]+)_test\\.cpp$")
      message(FATAL_ERROR "${file}: a file with tests is tests/FOLDER/NAME_test.cpp")
    endif()
    set(entry ${CMAKE_MATCH_1}.${CMAKE_MATCH_2})
    if(home AND NOT home STREQUAL entry)
      message(FATAL_ERROR "the suite ${name} stands in two files, ${home} and ${entry}: give it a name in each")
    endif()
    set(home ${entry})
  endforeach()
  if(NOT home IN_LIST entries)
    list(APPEND entries ${home})
    set(filter_${home} ${name}.*)
    set(cases_${home} ${count})
  else()
    string(APPEND filter_${home} ":${name}.*")
    math(EXPR cases_${home} "${cases_${home}} + ${count}")
  endif()
endforeach()

# Every case stands in an entry.
set(sum 0)
foreach(entry IN LISTS entries)
  math(EXPR sum "${sum} + ${cases_${entry}}")
endforeach()
string(JSON all GET ${list} tests)
if(NOT sum EQUAL all)
  message(FATAL_ERROR "${PROGRAM} has ${all} cases, its entries ${sum}")
endif()

set(named ${QUICK} ${SECONDS})
list(TRANSFORM named REPLACE "=.*" "")
foreach(name IN LISTS named)
  set(known ${entries})
  list(FILTER known INCLUDE REGEX "^${name}($|\\.)")
  if(NOT known)
    message(FATAL_ERROR "QUICK or SECONDS names ${name}: ${PROGRAM} has no such file of tests")
  endif()
endforeach()

set(text "")
foreach(entry IN LISTS entries)
  string(REGEX REPLACE "\\..*" "" folder ${entry})
  set(labels ${folder})
  if(entry IN_LIST QUICK OR folder IN_LIST QUICK)
    list(APPEND labels quick)
  endif()
  set(cost "")
  foreach(pair IN LISTS SECONDS)
    if(pair MATCHES "^(.*)=([0-9]+)$" AND CMAKE_MATCH_1 STREQUAL entry)
      set(cost " COST ${CMAKE_MATCH_2}")
    endif()
  endforeach()
  # Each case has a time limit of its own (tests/support/main.cpp); this one is for whatever hangs around them.
  string(APPEND text
         "# ${cases_${entry}} cases\n"
         "add_test([=[${entry}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter_${entry}}]=])\n"
         "set_tests_properties([=[${entry}]=] PROPERTIES LABELS [=[${labels}]=]${cost} TIMEOUT 3600"
         " SKIP_RETURN_CODE 77)\n")
endforeach()
file(WRITE ${OUT} "${text}")
