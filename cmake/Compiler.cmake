# Warnings and sanitizers sit in one private target that is never exported.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
  message(FATAL_ERROR "adit needs GCC 12 or newer (found ${CMAKE_CXX_COMPILER_VERSION})")
elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  message(FATAL_ERROR "adit needs Clang 14 or newer (found ${CMAKE_CXX_COMPILER_VERSION})")
endif()

add_library(adit_private INTERFACE)
target_compile_options(adit_private INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bug 105651: a false alarm inside std::string's operator+.
  target_compile_options(adit_private INTERFACE -Wno-restrict)
endif()
# A replay gives the same on every machine: no compiler fuses a product and a sum where it can.
target_compile_options(adit_private INTERFACE -ffp-contract=off)
if(ADIT_WARNINGS_AS_ERRORS)
  target_compile_options(adit_private INTERFACE -Werror)
endif()

# Sanitizers must reach every object, the tests' included, so they are set for the directory.
if(ADIT_SANITIZE)
  add_compile_options(-fsanitize=${ADIT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${ADIT_SANITIZE})
endif()
