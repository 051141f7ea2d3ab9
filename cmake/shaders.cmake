# irradia_kernels(TARGET DIR): every DIR/*.comp becomes SPIR-V embedded in a library, with records read through texel
# views and through storage buffers. DIR/NAME.comp is declared in "kernels/<last folder of DIR>.h" as
# irradia::kernels::NAME (a KernelSource).
function(irradia_kernels target dir)
  get_filename_component(group ${dir} NAME)
  set(out ${CMAKE_BINARY_DIR}/kernels/${group})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${dir}/*.comp)
  set(declarations "#pragma once\n#include \"engine/gpu/kernel.h\"\nnamespace irradia::kernels {\n")
  set(definitions "#include \"kernels/${group}.h\"\n")
  set(table "namespace irradia::kernels {\n")
  set(outputs)
  foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    foreach(variant texel storage)
      string(TOUPPER ${variant} upper)
      set(spirv ${out}/${name}.${variant}.inc)
      add_custom_command(OUTPUT ${spirv}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${out}
        COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.2 -DRECORDS_IN_${upper} -I${CMAKE_SOURCE_DIR}/shaders
                --depfile ${spirv}.d --vn ${name}_${variant} -o ${spirv} ${source}
        DEPENDS ${source} DEPFILE ${spirv}.d # which names the files it includes
        COMMENT "GLSL ${group}/${name} (${variant})" VERBATIM)
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
