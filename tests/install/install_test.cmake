# Installs the build into a scratch prefix and builds two programs against it as a user would: one of
# the core alone with fmt hidden, one that reads a plan.
set(prefix ${SCRATCH}/prefix)
set(cxx -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS}
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${prefix})

function(step name)
  message(STATUS "${name}")
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${name} failed (${status}):\n${output}")
  endif()
  set(step_output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
step("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

file(GLOB_RECURSE installed RELATIVE ${prefix} ${prefix}/*)
file(GLOB_RECURSE package ${prefix}/*.cmake)
foreach(file IN LISTS installed)
  if(file MATCHES "_test\\.|/tests?/|gtest")
    message(FATAL_ERROR "installed, but only for tests: ${file}")
  endif()
endforeach()
foreach(file IN LISTS package)
  file(READ ${file} text)
  foreach(secret ${SOURCE} ${BUILD} adit_private)
    string(FIND "${text}" "${secret}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names ${secret}, which a user does not have")
    endif()
  endforeach()
endforeach()

# The README shows the program that is built here.
set(consumer ${CMAKE_CURRENT_LIST_DIR}/consumer)
file(READ ${consumer}/io/first_program.cpp program)
file(READ ${SOURCE}/README.md readme)
string(FIND "${readme}" "${program}" position)
if(position EQUAL -1)
  message(FATAL_ERROR "README.md does not show ${consumer}/io/first_program.cpp as it is")
endif()

foreach(part core io)
  step("configure ${part}" ${CMAKE_COMMAND} -S ${consumer}/${part} -B ${SCRATCH}/${part} ${cxx})
  step("build ${part}" ${CMAKE_COMMAND} --build ${SCRATCH}/${part})
endforeach()
step("run core" ${SCRATCH}/core/first_program)
step("run io" ${SCRATCH}/io/first_program ${consumer}/io/plan.csv ${consumer}/io/log.clf)
if(NOT step_output MATCHES "12\\.000: [^\n]* ok\n$")
  message(FATAL_ERROR "the last of the five scans was not answered `ok`:\n${step_output}")
endif()

# Asking for the component where fmt is missing must fail with a reason, not at link time.
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${consumer}/io -B ${SCRATCH}/io_without_fmt ${cxx}
    -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON
  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "needs the package fmt")
  message(FATAL_ERROR "find_package(adit COMPONENTS io) without fmt: ${status}\n${output}")
endif()
