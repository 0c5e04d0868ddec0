# Warnings, sanitizers and the optimisation target, as one interface target.
add_library(penumbra_warnings INTERFACE)
add_library(Penumbra::warnings ALIAS penumbra_warnings)
target_compile_options(penumbra_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)

# Baseline x86-64 machines of the last ten years (AVX2, FMA); other architectures build as they are.
# Contraction is off, so that the same source gives the same bits on every one of them.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_options(-march=x86-64-v3)
endif()
add_compile_options(-ffp-contract=off -fno-math-errno)

if(PENUMBRA_SANITIZE)
  add_compile_options(-fsanitize=${PENUMBRA_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PENUMBRA_SANITIZE})
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
