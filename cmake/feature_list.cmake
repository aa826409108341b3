# The features of kernels/shared/features.h as a list that the host's macros can walk, WHITTLE_FEATURES(X): a macro cannot
# read other macros. Written again when that file changes.
set(feature_source ${CMAKE_SOURCE_DIR}/kernels/shared/features.h)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${feature_source})
file(STRINGS ${feature_source} feature_lines ENCODING UTF-8 REGEX "^#define BIT_")
set(feature_rows "")
foreach(line ${feature_lines})
  if(NOT line MATCHES "^#define BIT_([A-Z0-9_]+) ([0-9]+) +// (.+)$")
    message(FATAL_ERROR "${feature_source}: not '#define BIT_NAME bit  // what a person calls it': ${line}")
  endif()
  string(APPEND feature_rows " \\\n  X(${CMAKE_MATCH_1}, ${CMAKE_MATCH_2}, \"${CMAKE_MATCH_3}\")")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/feature_list.h @ONLY
     CONTENT "// Generated from kernels/shared/features.h.\n#pragma once\n\n#define WHITTLE_FEATURES(X)@feature_rows@\n")
