# -DPELLUCID_SANITIZE=ON: address + undefined behaviour, for the tests that need no OpenGL.
option(PELLUCID_SANITIZE "Build with address and undefined-behaviour sanitizers" OFF)
if(PELLUCID_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
