# The installed tree by itself: from another folder, bin/whittle reads a scene with textures and writes pictures, so it
# finds its image codec in lib/whittle; and again after the tree has moved. Without the codec it says what is missing.
# Reads BUILD (the build folder), SCENE (with textures), VERSION, OUT (a folder of its own, emptied first).
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${OUT})
set(elsewhere "${OUT}/another folder")
file(MAKE_DIRECTORY ${elsewhere})

# run(TREE STATUS ARGS…): runs its whittle in the other folder; leaves what it wrote in `out` and `err`.
function(run tree status)
  execute_process(COMMAND ${tree}/bin/whittle ${ARGN} WORKING_DIRECTORY ${elsewhere}
                  RESULT_VARIABLE found OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT found EQUAL status)
    message(FATAL_ERROR "${tree}/bin/whittle ${ARGN}: status ${found}, not ${status}\n${out}${err}")
  endif()
  set(out ${out} PARENT_SCOPE)
  set(err ${err} PARENT_SCOPE)
endfunction()

# expectStart(NAME HEX): the first bytes of a file in the other folder.
function(expectStart name hex)
  string(LENGTH ${hex} digits)
  math(EXPR bytes "${digits} / 2")
  file(READ ${elsewhere}/${name} start LIMIT ${bytes} HEX)
  if(NOT start STREQUAL hex)
    message(FATAL_ERROR "${name} starts with ${start}, not ${hex}")
  endif()
endfunction()

function(expectWorks tree)
  run(${tree} 0 --version)
  if(NOT out STREQUAL "whittle ${VERSION}\n")
    message(FATAL_ERROR "--version says ${out}")
  endif()
  run(${tree} 0 render ${SCENE} --width 16 --height 9 --quiet -o a.png -o a.exr)
  expectStart(a.png 89504e470d0a1a0a)
  expectStart(a.exr 762f3101)
  run(${tree} 0 compare a.exr a.exr)
  file(REMOVE ${elsewhere}/a.png ${elsewhere}/a.exr)
endfunction()

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${OUT}/tree OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
expectWorks(${OUT}/tree)
file(RENAME ${OUT}/tree "${OUT}/moved tree")
expectWorks("${OUT}/moved tree")
run("${OUT}/moved tree" 2 render nope.glb -o a.png)
file(REMOVE_RECURSE "${OUT}/moved tree/lib")
run("${OUT}/moved tree" 0 render ${SCENE} --width 16 --height 9 --quiet -o a.png)  # plain pictures need none
run("${OUT}/moved tree" 1 render ${SCENE} --width 16 --height 9 --quiet -o a.exr)
if(NOT err MATCHES "libwhittle_codec")
  message(FATAL_ERROR "without its codec it says ${err}")
endif()
file(REMOVE_RECURSE ${OUT})
