# A quicker build: less is read twice. Neither option changes what a program computes.
#
# ADIT_UNITY compiles files of one target together. Two files that define the same name (each in an
# anonymous namespace of its own, say) are never in one unit: the names are read at configuration.
# ADIT_PCH reads Eigen, the standard library and the test libraries once, as precompiled headers.
#
# Both hide a missing #include: the `debug` preset compiles each file by itself.
option(ADIT_UNITY "Compile several files of a target together" OFF)
option(ADIT_PCH "Use precompiled headers" OFF)
set(adit_unit_files 12)  # of one unit at most: several units of a large room compile at the same time
# For clang-tidy, to which the headers are most of the work, the files of all rooms share their units.
option(ADIT_LINT "Only write a compilation database for clang-tidy" OFF)
if(ADIT_LINT)
  set(adit_unit_files 24)
endif()

# adit_names(file defined used): the names that the file defines outside of classes and functions, so at
# the start of a line, and those that it takes from another namespace.
function(adit_names file defined used)
  file(STRINGS ${file} lines REGEX "^[A-Za-z_]")
  set(names)
  set(taken)
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "\"[^\"]*\"|//.*" "" line "${line}")
    if(line MATCHES "^(struct|class|enum class|enum|union|using) ([A-Za-z_0-9]+)( [:={].*|;|$)")
      list(APPEND names ${CMAKE_MATCH_2})
    elseif(line MATCHES "^using .*::([A-Za-z_0-9]+);")
      list(APPEND taken ${CMAKE_MATCH_1})
    elseif(line MATCHES "^(namespace|using|template|TEST|RC_|INSTANTIATE|BENCHMARK)")
      continue()
    elseif(line MATCHES "^[A-Za-z_][^(={]*[ &*]([A-Za-z_0-9]+)(\\[.*|;.*| ?[(={].*|$)")
      list(APPEND names ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(${defined} ${names} PARENT_SCOPE)
  set(${used} ${taken} PARENT_SCOPE)
endfunction()

# adit_header_constants(folder out): the constants of the folder's headers.
function(adit_header_constants folder out)
  get_property(known GLOBAL PROPERTY adit_constants_${folder} SET)
  if(known)
    get_property(constants GLOBAL PROPERTY adit_constants_${folder})
    set(${out} ${constants} PARENT_SCOPE)
    return()
  endif()
  file(GLOB headers ${folder}/*.hpp)
  set(constants)
  foreach(header IN LISTS headers)
    file(STRINGS ${header} lines REGEX "^(inline )?constexpr .* k[A-Z][A-Za-z0-9]*( =|{)")
    foreach(line IN LISTS lines)
      if(line MATCHES " (k[A-Z][A-Za-z0-9]*)( =|{)")
        list(APPEND constants ${CMAKE_MATCH_1})
      endif()
    endforeach()
  endforeach()
  set_property(GLOBAL PROPERTY adit_constants_${folder} "${constants}")
  set(${out} ${constants} PARENT_SCOPE)
endfunction()

# adit_meet(out THESE name... AND name...): whether the lists have a name in common.
function(adit_meet out)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "THESE;AND")
  set(found FALSE)
  foreach(name IN LISTS arg_THESE)
    if(name IN_LIST arg_AND)
      set(found TRUE)
      break()
    endif()
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# adit_types(out file...): the types that the files define at the start of a line.
function(adit_types out)
  set(types)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} lines REGEX "^(struct|class|enum class|enum|union|using) [A-Za-z_0-9]+( [:={]|;|$)")
    foreach(line IN LISTS lines)
      if(line MATCHES "^(struct|class|enum class|enum|union|using) ([A-Za-z_0-9]+)")
        list(APPEND types ${CMAKE_MATCH_2})
      endif()
    endforeach()
  endforeach()
  set(${out} ${types} PARENT_SCOPE)
endfunction()

# adit_unity(target file...): each file joins the first unit that has room and with which it has no name in
# common. What takes in a whole namespace, or has a constant of the same name as a header, stays alone.
function(adit_unity target)
  if(NOT ADIT_UNITY)
    return()
  endif()
  set(units 0)
  set(public_types)
  if(ADIT_LINT)
    # Whoever names a type of its own as another room does is not joined with what reads that room.
    file(GLOB headers ${PROJECT_SOURCE_DIR}/src/adit/*/*.hpp)
    adit_types(public_types ${headers})
  endif()
  foreach(file IN LISTS ARGN)
    get_filename_component(path ${file} ABSOLUTE)
    get_filename_component(folder ${path} DIRECTORY)
    adit_names(${path} names taken)
    adit_header_constants(${folder} constants)
    adit_meet(shadows THESE ${names} AND ${constants})
    file(STRINGS ${path} whole REGEX "^using namespace ")
    adit_types(own_types ${path})
    adit_meet(homonym THESE ${own_types} AND ${public_types})
    if(shadows OR whole OR homonym)
      set_source_files_properties(${file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      continue()
    endif()
    set(unit 0)
    while(unit LESS units)
      adit_meet(clash THESE ${names} AND ${names_${unit}} ${taken_${unit}})
      adit_meet(taken_clash THESE ${taken} AND ${names_${unit}})
      if(NOT clash AND NOT taken_clash AND count_${unit} LESS adit_unit_files)
        break()
      endif()
      math(EXPR unit "${unit} + 1")
    endwhile()
    if(unit EQUAL units)
      math(EXPR units "${units} + 1")
      set(count_${unit} 0)
    endif()
    list(APPEND names_${unit} ${names})
    list(APPEND taken_${unit} ${taken})
    math(EXPR count_${unit} "${count_${unit}} + 1")
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${target}_${unit})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Taken for a header, a source may not keep what it alone knows in a class.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

set(adit_headers <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional>
  <limits> <map> <memory> <numeric> <optional> <random> <set> <span> <sstream> <string> <string_view>
  <tuple> <utility> <variant> <vector> <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/LU>
  <tl/expected.hpp>)
set(adit_test_headers ${adit_headers} <gtest/gtest.h> <rapidcheck/gtest.h>)

# adit_precompiled(target holder): uses the precompiled headers of the holder, one of those below. A target
# that is compiled with other flags than its holder needs another holder.
function(adit_precompiled target holder)
  if(ADIT_PCH)
    target_precompile_headers(${target} REUSE_FROM ${holder})
  endif()
endfunction()

# adit_holder(name header... [LIBRARIES target...] [OPTIONS option...])
function(adit_holder name)
  cmake_parse_arguments(arg "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  set(nothing ${CMAKE_BINARY_DIR}/${name}.cpp)
  if(NOT EXISTS ${nothing})
    file(WRITE ${nothing} "")
  endif()
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${nothing})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} adit_private)
  target_compile_options(${name} PRIVATE ${arg_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()

# What only drives a test need not be fast; the libraries that it tests are.
set(adit_test_options $<$<CONFIG:Release>:-O1>)

if(ADIT_PCH)
  adit_holder(adit_room_headers HEADERS ${adit_headers} LIBRARIES Eigen3::Eigen tl::expected)
  set_target_properties(adit_room_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)
  adit_holder(adit_program_headers HEADERS ${adit_headers} LIBRARIES Eigen3::Eigen tl::expected)
  if(ADIT_BUILD_TESTS)
    adit_holder(adit_test_headers HEADERS ${adit_test_headers} OPTIONS ${adit_test_options}
      LIBRARIES Eigen3::Eigen tl::expected rapidcheck GTest::gtest)
  endif()
endif()

# adit_without_string_alarms(target): where more is compiled at once, GCC 12 inlines std::string's operator+
# so that it warns of copies that cannot be (GCC bug 105651 again).
function(adit_without_string_alarms target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-array-bounds)
  endif()
endfunction()
