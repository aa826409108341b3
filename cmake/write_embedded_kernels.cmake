# Writes OUT: a C++ file that maps each path below DIR to the text of its file.
# Writes PARAMETERS: a header with the parameters of each kernel, "TYPE NAME, TYPE NAME, …", and of SCENE_PARAMS.
file(GLOB_RECURSE files RELATIVE ${DIR} ${DIR}/*.cl ${DIR}/*.h)
list(SORT files)
set(text "// Generated from kernels/ at build time.\n#include \"cl/kernel_source.h\"\n\nnamespace whittle {\n\n")
string(APPEND text "const std::map<std::string, std::string>& embeddedKernelFiles() {\n")
string(APPEND text "  static const std::map<std::string, std::string> files = {\n")
set(rows "")

# addRow(NAME PARAMETERS): blanks as a single one each, stars beside their type.
function(addRow name parameters)
  string(REGEX REPLACE "[ \n\\]+" " " parameters "${parameters}")
  string(REGEX REPLACE " ?\\* ?" "* " parameters "${parameters}")
  string(STRIP "${parameters}" parameters)
  set(rows "${rows}    {\"${name}\", \"${parameters}\"},\n" PARENT_SCOPE)
endfunction()

foreach(file ${files})
  file(READ ${DIR}/${file} content)
  string(APPEND text "      {\"${file}\", R\"whittle_source(${content})whittle_source\"},\n")
  string(REGEX REPLACE "//[^\n]*" "" code "${content}")
  string(REGEX MATCHALL "__kernel void [a-z_]+\\([^)]*\\)" kernels "${code}")
  foreach(kernel IN LISTS kernels)
    string(REGEX MATCH "__kernel void ([a-z_]+)\\(([^)]*)\\)" _ "${kernel}")
    addRow("${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
  endforeach()
  string(REPLACE "\\\n" " " code "${code}")
  if(code MATCHES "#define SCENE_PARAMS ([^\n]*)")
    addRow(SCENE_PARAMS "${CMAKE_MATCH_1}")
  endif()
endforeach()
string(APPEND text "  };\n  return files;\n}\n\n}  // namespace whittle\n")
file(WRITE ${OUT} "${text}")
file(WRITE ${PARAMETERS} "// Generated from kernels/ at build time.
#pragma once

#include <string_view>
#include <utility>

namespace whittle {

inline constexpr std::pair<std::string_view, std::string_view> kKernelParameters[] = {
${rows}};

}  // namespace whittle
")
