# How every target is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(ENDOWIRE_PYTHON)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)  # the layers also go into a module of Python
endif()

add_library(endowire_compile INTERFACE)
target_compile_features(endowire_compile INTERFACE cxx_std_20)
# No fused multiply-add behind our back and no -ffast-math: the same input gives the same bits
# whatever the optimisation level, on every machine of one instruction set.
target_compile_options(endowire_compile INTERFACE
  -ffp-contract=off -Wno-psabi -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  $<$<BOOL:${ENDOWIRE_WERROR}>:-Werror>)
if(ENDOWIRE_PYTHON)
  # Nobody replaces one of our functions at load time, so calls within a file stay open to inlining.
  target_compile_options(endowire_compile INTERFACE -fno-semantic-interposition)
endif()
if(ENDOWIRE_SANITIZE)
  target_compile_options(endowire_compile INTERFACE
    -fsanitize=${ENDOWIRE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(endowire_compile INTERFACE -fsanitize=${ENDOWIRE_SANITIZE})
endif()
if(EMSCRIPTEN)  # exceptions are off by default there
  target_compile_options(endowire_compile INTERFACE -fexceptions)
  target_link_options(endowire_compile INTERFACE -fexceptions)
endif()
