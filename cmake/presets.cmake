# irradia_presets(TARGET DIR): every DIR/*.json becomes a text that the library holds, in DIR's parent as presets.h:
# kPresets, a list of {name, text}.
function(irradia_presets target dir)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${dir}/*.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})
  set(list)
  foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    file(READ ${source} text)
    string(APPEND list "    {\"${name}\", R\"json(${text})json\"},\n")
  endforeach()
  get_filename_component(parent ${dir} DIRECTORY)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/presets/${parent}/presets.h CONTENT
    "#pragma once\nnamespace irradia {\nstruct Preset {\n    const char* name;\n    const char* text;\n};\ninline constexpr Preset kPresets[] = {\n@list@};\n} // namespace irradia\n" @ONLY)
  target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/presets)
endfunction()
