# Targets `format` (rewrites) and `format-check` (fails on a difference) over every C++ file; headers shared with GLSL
# keep their own. Versions of clang-format differ in details: the style is that of Debian 12's, 14.
find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
if(CLANG_FORMAT)
  set(patterns)
  foreach(folder engine nrc samples tests)
    list(APPEND patterns ${CMAKE_SOURCE_DIR}/${folder}/*.cpp ${CMAKE_SOURCE_DIR}/${folder}/*.h)
  endforeach()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})
  add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${sources} VERBATIM)
  add_custom_target(format-check COMMAND ${CLANG_FORMAT} --dry-run -Werror ${sources} VERBATIM)
endif()
