# The styles and scripts of report pages become part of the binary: a generated .cpp that maps each file's name to its text.
set(page_folder ${CMAKE_SOURCE_DIR}/host/report/page)
file(GLOB page_files CONFIGURE_DEPENDS ${page_folder}/*.css ${page_folder}/*.js)
set(embedded_pages ${generated_dir}/embedded_pages.cpp)
add_custom_command(
  OUTPUT ${embedded_pages}
  COMMAND ${CMAKE_COMMAND} -DOUT=${embedded_pages} -DDIR=${page_folder} -P ${CMAKE_SOURCE_DIR}/cmake/write_embedded_pages.cmake
  DEPENDS ${page_files} ${CMAKE_SOURCE_DIR}/cmake/write_embedded_pages.cmake
  VERBATIM)
