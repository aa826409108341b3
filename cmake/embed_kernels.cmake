# Kernel sources become part of the binary: one generated .cpp that holds every file under kernels/ as text, and a
# header with the parameter list of each kernel, which the host's launches are compiled against.
file(GLOB_RECURSE kernel_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/kernels/*.cl ${CMAKE_SOURCE_DIR}/kernels/*.h)
set(generated_dir ${CMAKE_BINARY_DIR}/generated)
set(embedded_kernels ${generated_dir}/embedded_kernels.cpp)
set(kernel_parameters ${generated_dir}/kernel_parameters.h)
add_custom_command(
  OUTPUT ${embedded_kernels} ${kernel_parameters}
  COMMAND ${CMAKE_COMMAND} -DOUT=${embedded_kernels} -DPARAMETERS=${kernel_parameters} -DDIR=${CMAKE_SOURCE_DIR}/kernels
          -P ${CMAKE_SOURCE_DIR}/cmake/write_embedded_kernels.cmake
  DEPENDS ${kernel_files} ${CMAKE_SOURCE_DIR}/cmake/write_embedded_kernels.cmake
  VERBATIM)
add_custom_target(kernel_texts DEPENDS ${embedded_kernels} ${kernel_parameters})
