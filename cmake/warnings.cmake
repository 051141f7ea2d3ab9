# What every target of the project is compiled with.
add_library(irradia_warnings INTERFACE)
target_compile_options(irradia_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Wno-missing-field-initializers # Vulkan's structs: VkSubmitInfo{VK_STRUCTURE_TYPE_SUBMIT_INFO}
  -Werror)
if(IRRADIA_SANITIZE)
  target_compile_options(irradia_warnings INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(irradia_warnings INTERFACE -fsanitize=address,undefined)
endif()
