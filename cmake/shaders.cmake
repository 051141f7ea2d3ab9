# irradia_kernels(TARGET DIR [VARIANTS VARIANT...]): every DIR/*.comp becomes SPIR-V embedded in a library, with quads read
# through texel views and through storage buffers. DIR/NAME.comp is declared in "kernels/<last folder of DIR>.h" as
# irradia::kernels::NAME (a KernelSource).
#
# What a kernel includes by name alone comes from the folders of its line "#pragma folders FOLDER ...". A line
# "#pragma variant OTHER WORD ..." declares OTHER likewise: a word with a slash is a folder that comes before these, so that
# its files take the place of theirs; any other is a macro that is defined. A VARIANT, "OTHER path/to/NAME.comp WORD ...",
# does so for a kernel of another folder. Folders are of shaders/, or of the project.
function(irradia_kernel_flags result source) # of WORD ...
  set(flags)
  foreach(word ${ARGN})
    if(NOT word MATCHES "/")
      list(APPEND flags -D${word})
    elseif(IS_DIRECTORY ${CMAKE_SOURCE_DIR}/shaders/${word})
      list(APPEND flags -I${CMAKE_SOURCE_DIR}/shaders/${word})
    else()
      list(APPEND flags -I${CMAKE_SOURCE_DIR}/${word})
    endif()
  endforeach()
  file(STRINGS ${source} folders REGEX "^#pragma folders ")
  separate_arguments(folders UNIX_COMMAND "${folders}")
  if(folders)
    list(POP_FRONT folders pragma keyword)
    list(TRANSFORM folders PREPEND -I${CMAKE_SOURCE_DIR}/shaders/)
  endif()
  set(${result} ${flags} ${folders} -I${CMAKE_SOURCE_DIR}/shaders PARENT_SCOPE)
endfunction()

function(irradia_kernels target dir)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "VARIANTS")
  get_filename_component(group ${dir} NAME)
  set(out ${CMAKE_BINARY_DIR}/kernels/${group})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${dir}/*.comp)
  set(all) # "NAME SOURCE WORD ..." each
  foreach(source ${sources})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source}) # for its variants
    get_filename_component(name ${source} NAME_WE)
    list(APPEND all "${name} ${source}")
    file(STRINGS ${source} variants REGEX "^#pragma variant ")
    list(TRANSFORM variants REPLACE "^#pragma variant ([a-z0-9_]+)" "\\1 ${source}")
    list(APPEND all ${variants})
  endforeach()
  list(TRANSFORM arg_VARIANTS REPLACE "^([a-z0-9_]+) " "\\1 ${CMAKE_SOURCE_DIR}/")
  set(declarations "#pragma once\n#include \"engine/gpu/kernel.h\"\nnamespace irradia::kernels {\n")
  set(definitions "#include \"kernels/${group}.h\"\n")
  set(table "namespace irradia::kernels {\n")
  set(outputs)
  foreach(kernel ${all} ${arg_VARIANTS})
    separate_arguments(words UNIX_COMMAND "${kernel}")
    list(POP_FRONT words name source)
    irradia_kernel_flags(flags ${source} ${words})
    foreach(records texel storage)
      string(TOUPPER ${records} upper)
      set(spirv ${out}/${name}.${records}.inc)
      add_custom_command(OUTPUT ${spirv}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${out}
        COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.2 -DQUADS_IN_${upper} ${flags}
                --depfile ${spirv}.d --vn ${name}_${records} -o ${spirv} ${source}
        DEPENDS ${source} DEPFILE ${spirv}.d # which names the files it includes
        COMMENT "GLSL ${group}/${name} (${records})" VERBATIM)
      list(APPEND outputs ${spirv})
      string(APPEND definitions "#include \"${spirv}\"\n")
    endforeach()
    string(APPEND declarations "extern const KernelSource ${name};\n")
    string(APPEND table "const KernelSource ${name}{\"${name}\", ${name}_texel, ${name}_storage};\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/kernels/${group}.h CONTENT "${declarations}} // namespace irradia::kernels\n" @ONLY)
  file(CONFIGURE OUTPUT ${out}/${group}.cpp CONTENT "${definitions}${table}} // namespace irradia::kernels\n" @ONLY)
  set_source_files_properties(${out}/${group}.cpp PROPERTIES OBJECT_DEPENDS "${outputs}")
  add_library(${target} STATIC ${out}/${group}.cpp ${outputs})
  target_include_directories(${target} PUBLIC ${CMAKE_BINARY_DIR})
  target_link_libraries(${target} PUBLIC irradia_gpu)
endfunction()
