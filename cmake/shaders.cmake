# irradia_kernels(TARGET DIR): every DIR/*.comp becomes SPIR-V embedded in a library, with records read through texel
# views and through storage buffers. DIR/NAME.comp is declared in "kernels/<last folder of DIR>.h" as
# irradia::kernels::NAME (a KernelSource). A line "#pragma variant OTHER MACRO ..." in it declares OTHER likewise, compiled
# with these macros defined.
function(irradia_kernels target dir)
  get_filename_component(group ${dir} NAME)
  set(out ${CMAKE_BINARY_DIR}/kernels/${group})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${dir}/*.comp)
  set(declarations "#pragma once\n#include \"engine/gpu/kernel.h\"\nnamespace irradia::kernels {\n")
  set(definitions "#include \"kernels/${group}.h\"\n")
  set(table "namespace irradia::kernels {\n")
  set(outputs)
  foreach(source ${sources})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source}) # for its variants
    get_filename_component(own_name ${source} NAME_WE)
    file(STRINGS ${source} variants REGEX "^#pragma variant ")
    foreach(variant "#pragma variant ${own_name}" ${variants})
      separate_arguments(macros UNIX_COMMAND "${variant}")
      list(POP_FRONT macros pragma keyword name)
      list(TRANSFORM macros PREPEND -D)
      foreach(records texel storage)
        string(TOUPPER ${records} upper)
        set(spirv ${out}/${name}.${records}.inc)
        add_custom_command(OUTPUT ${spirv}
          COMMAND ${CMAKE_COMMAND} -E make_directory ${out}
          COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.2 -DRECORDS_IN_${upper} ${macros} -I${CMAKE_SOURCE_DIR}/shaders
                  --depfile ${spirv}.d --vn ${name}_${records} -o ${spirv} ${source}
          DEPENDS ${source} DEPFILE ${spirv}.d # which names the files it includes
          COMMENT "GLSL ${group}/${name} (${records})" VERBATIM)
        list(APPEND outputs ${spirv})
        string(APPEND definitions "#include \"${spirv}\"\n")
      endforeach()
      string(APPEND declarations "extern const KernelSource ${name};\n")
      string(APPEND table "const KernelSource ${name}{\"${name}\", ${name}_texel, ${name}_storage};\n")
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/kernels/${group}.h CONTENT "${declarations}} // namespace irradia::kernels\n" @ONLY)
  file(CONFIGURE OUTPUT ${out}/${group}.cpp CONTENT "${definitions}${table}} // namespace irradia::kernels\n" @ONLY)
  set_source_files_properties(${out}/${group}.cpp PROPERTIES OBJECT_DEPENDS "${outputs}")
  add_library(${target} STATIC ${out}/${group}.cpp ${outputs})
  target_include_directories(${target} PUBLIC ${CMAKE_BINARY_DIR})
  target_link_libraries(${target} PUBLIC irradia_gpu)
endfunction()
