# cmake -DPRESET=asan [-DTESTS=asan-whole] -P sanitizers.cmake: the library and its unit tests, simulations among them, run
# clean. TESTS names the preset of the tests where it is another: of whole anatomies, which take most of the time, `asan`
# makes each once.
cmake_minimum_required(VERSION 3.22)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
if(NOT TESTS)
  set(TESTS ${PRESET})
endif()
cmake_host_system_information(RESULT jobs QUERY NUMBER_OF_LOGICAL_CORES)
foreach(command
    "${CMAKE_COMMAND} --preset ${PRESET}"
    "${CMAKE_COMMAND} --build --preset ${PRESET} --parallel ${jobs}"
    "${CMAKE_CTEST_COMMAND} --preset ${TESTS} --parallel ${jobs}")
  separate_arguments(words UNIX_COMMAND ${command})
  execute_process(COMMAND ${words} WORKING_DIRECTORY ${root} RESULT_VARIABLE result)
  if(result)
    message(FATAL_ERROR "failed: ${command}")
  endif()
endforeach()
