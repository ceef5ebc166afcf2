# The page of a report: readable files of src/endowire/io/report, put into endowire_io as strings.
set(page ${PROJECT_SOURCE_DIR}/src/endowire/io/report)
set(page_scripts ${page}/data.js ${page}/matrix.js ${page}/shaders.js ${page}/tube.js ${page}/scene.js ${page}/chart.js
  ${page}/timeline.js ${page}/page.js)
set(page_code ${PROJECT_BINARY_DIR}/report_page.cpp)
add_custom_command(OUTPUT ${page_code}
  COMMAND ${CMAKE_COMMAND} -DOUT=${page_code} -DHTML=${page}/page.html -DSTYLE=${page}/page.css "-DSCRIPTS=${page_scripts}"
    -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
  DEPENDS ${page}/page.html ${page}/page.css ${page_scripts} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
  COMMENT "Putting the page of a report into endowire_io" VERBATIM)
target_sources(endowire_io PRIVATE ${page_code})
