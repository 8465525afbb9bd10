# Every target of ours links this; warnings are errors everywhere.
add_library(pellucid_warnings INTERFACE)
target_compile_options(pellucid_warnings INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Woverloaded-virtual -Wnon-virtual-dtor
  -Wno-sign-conversion -Werror)
target_include_directories(pellucid_warnings INTERFACE ${PROJECT_SOURCE_DIR})
