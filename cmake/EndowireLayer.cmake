# endowire_layer(name [DEPENDS layers...]): one folder of src/endowire, with the folders in it, is one target.
function(endowire_layer name)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/endowire/${name}/*.cpp
    ${PROJECT_SOURCE_DIR}/src/endowire/${name}/*/*.cpp)
  if(sources)
    add_library(endowire_${name} STATIC ${sources})
    set(scope PUBLIC)
  else()
    add_library(endowire_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(endowire::${name} ALIAS endowire_${name})
  target_include_directories(endowire_${name} ${scope} ${PROJECT_SOURCE_DIR}/src)
  # Eigen's own headers are not held to our warnings.
  target_include_directories(endowire_${name} SYSTEM ${scope}
    $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(endowire_${name} ${scope} endowire_compile)
  foreach(layer IN LISTS arg_DEPENDS)
    target_link_libraries(endowire_${name} ${scope} endowire_${layer})
  endforeach()
endfunction()
