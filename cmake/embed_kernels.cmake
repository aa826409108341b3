# Kernel sources become part of the binary: one generated .cpp that holds every file under kernels/ as text.
file(GLOB_RECURSE kernel_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/kernels/*.cl ${CMAKE_SOURCE_DIR}/kernels/*.h)
set(embedded_kernels ${CMAKE_BINARY_DIR}/generated/embedded_kernels.cpp)
add_custom_command(
  OUTPUT ${embedded_kernels}
  COMMAND ${CMAKE_COMMAND} -DOUT=${embedded_kernels} -DDIR=${CMAKE_SOURCE_DIR}/kernels
          -P ${CMAKE_SOURCE_DIR}/cmake/write_embedded_kernels.cmake
  DEPENDS ${kernel_files} ${CMAKE_SOURCE_DIR}/cmake/write_embedded_kernels.cmake
  VERBATIM)
