# embed_text(TARGET NAME FILES...): compiles text files (shaders, presets, schemas) into TARGET. Afterwards its sources can
#     #include "embedded/NAME.h"
# which declares
#     namespace pellucid::embedded { const std::map<std::string, std::string_view, std::less<>>& NAME(); }
# keyed by the path of each file relative to BASE (optional argument BASE DIR; default: the calling folder), with forward
# slashes. NAME is a C++ identifier. Editing a file rebuilds one source. The header is private to TARGET.
set(PELLUCID_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_text_generate.cmake)

function(embed_text target name)
  cmake_parse_arguments(PARSE_ARGV 2 E "" "BASE" "")
  if(NOT E_BASE)
    set(E_BASE ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embed_text)
  set(header ${folder}/embedded/${name}.h)
  set(source ${folder}/${name}.cpp)
  set(manifest "set(NAME ${name})\nset(KEYS)\nset(PATHS)\n")
  set(paths)
  foreach(file IN LISTS E_UNPARSED_ARGUMENTS)
    get_filename_component(path ${file} ABSOLUTE)
    file(RELATIVE_PATH key ${E_BASE} ${path})
    list(APPEND paths ${path})
    string(APPEND manifest "list(APPEND KEYS [[${key}]])\nlist(APPEND PATHS [[${path}]])\n")
  endforeach()
  # Written only when the list changes, so that configuring again rebuilds nothing.
  file(CONFIGURE OUTPUT ${folder}/${name}.manifest.cmake CONTENT "${manifest}" @ONLY)
  add_custom_command(
    OUTPUT ${header} ${source}
    COMMAND ${CMAKE_COMMAND} -D MANIFEST=${folder}/${name}.manifest.cmake -D HEADER=${header} -D SOURCE=${source}
            -P ${PELLUCID_EMBED_SCRIPT}
    DEPENDS ${paths} ${folder}/${name}.manifest.cmake ${PELLUCID_EMBED_SCRIPT}
    COMMENT "Embedding ${name}" VERBATIM)
  target_sources(${target} PRIVATE ${source} ${header})
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
