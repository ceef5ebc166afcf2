# cmake -DBUILD=folder -P tidy.cmake: clang-tidy 14 finds nothing in the library. What it looks for: .clang-tidy.
cmake_minimum_required(VERSION 3.22)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy-14 REQUIRED)
cmake_host_system_information(RESULT jobs QUERY NUMBER_OF_LOGICAL_CORES)
execute_process(
  COMMAND ${RUN_CLANG_TIDY} -quiet -j ${jobs} -p ${BUILD} "^${root}/src/.*"
  OUTPUT_VARIABLE found ERROR_VARIABLE chatter RESULT_VARIABLE result)
if(result)
  message(FATAL_ERROR "${found}\n${chatter}")
endif()
