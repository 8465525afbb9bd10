# Every target of ours links this; warnings are errors everywhere.
# -Wno-restrict: GCC 12 sees an overlap in every optimised `"text" + std::string` (GCC bug 105651).
# -Wno-maybe-uninitialized: sanitizer code hides initialisations from it, in <regex> and std::function for example.
add_library(pellucid_warnings INTERFACE)
target_compile_options(pellucid_warnings INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Woverloaded-virtual -Wnon-virtual-dtor
  -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -Werror)
target_include_directories(pellucid_warnings INTERFACE ${PROJECT_SOURCE_DIR})
if(PELLUCID_SANITIZE)
  target_compile_options(pellucid_warnings INTERFACE -Wno-maybe-uninitialized)
endif()
