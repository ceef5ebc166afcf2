# cmake -DNATIVE=folder -DBUILD=folder -P wasm.cmake: the layers below io build with Emscripten, and give the
# native answer under Node.
cmake_minimum_required(VERSION 3.22)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
find_program(EMCMAKE NAMES emcmake REQUIRED)
find_program(NODE NAMES node nodejs REQUIRED)
find_path(EIGEN_CMAKE Eigen3Config.cmake PATHS /usr/share/eigen3/cmake /usr/lib/cmake/eigen3 REQUIRED)
cmake_host_system_information(RESULT jobs QUERY NUMBER_OF_LOGICAL_CORES)
# A Node that is not Debian's does not look where Debian puts the JavaScript that Emscripten needs.
set(ENV{NODE_PATH} "/usr/share/nodejs:$ENV{NODE_PATH}")
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(result)
    list(JOIN ARGN " " words)
    message(FATAL_ERROR "failed: ${words}")
  endif()
endfunction()
run(${EMCMAKE} ${CMAKE_COMMAND} -S ${root} -B ${BUILD} -G Ninja -DCMAKE_BUILD_TYPE=Release -DENDOWIRE_WITH_IO=OFF
  -DENDOWIRE_TESTS=OFF -DEigen3_DIR=${EIGEN_CMAKE})
run(${CMAKE_COMMAND} --build ${BUILD} --parallel ${jobs})
foreach(program steps_in_torus generated_vessels)
  execute_process(COMMAND ${NODE} ${BUILD}/tests/wasm/${program}.js OUTPUT_FILE ${BUILD}/${program}.txt
    RESULT_VARIABLE result)
  if(result)
    message(FATAL_ERROR "${program}.js failed under Node")
  endif()
  run(${NATIVE}/${program} ${BUILD}/${program}.txt)
endforeach()
