# The page of `chasles view`: viewer/ bundled into one source file.
#
# What comes from the network comes while the project is configured, and only once: npm installs what viewer/'s lock file
# names into the build folder. The bundle is made while the project is built. Where anything is missing, the library is
# built all the same and says what; configuring again tries again.

set(viewer_dir ${PROJECT_SOURCE_DIR}/viewer)
set(viewer_work_dir ${PROJECT_BINARY_DIR}/viewer)

# Sets `result` to why the viewer cannot be built; empty if it can.
function(chasles_install_viewer_packages result)
  set(${result} "" PARENT_SCOPE)
  if(NOT CHASLES_VIEWER)
    set(${result} "it was switched off (CHASLES_VIEWER)" PARENT_SCOPE)
    return()
  endif()
  find_program(CHASLES_NODE node)
  find_program(CHASLES_NPM npm)
  if(NOT CHASLES_NODE OR NOT CHASLES_NPM)
    set(${result} "npm was not found; install it and configure again" PARENT_SCOPE)
    return()
  endif()
  set(lock ${viewer_dir}/package-lock.json)
  set(omitted "")
  if(NOT CHASLES_TESTS)
    set(omitted --omit=dev) # the compiler that checks types
  endif()
  set(installed_lock ${viewer_work_dir}/installed${omitted}.json)
  set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lock})
  if(EXISTS ${installed_lock})
    file(SHA256 ${lock} wanted)
    file(SHA256 ${installed_lock} present)
    if(wanted STREQUAL present)
      return()
    endif()
  endif()
  message(STATUS "Installing what the viewer is made from")
  file(COPY ${viewer_dir}/package.json ${lock} ${viewer_dir}/.npmrc DESTINATION ${viewer_work_dir})
  execute_process(
    COMMAND ${CHASLES_NPM} ci ${omitted} --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error
    WORKING_DIRECTORY ${viewer_work_dir}
    TIMEOUT 300
    RESULT_VARIABLE status
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(status EQUAL 0)
    file(COPY_FILE ${lock} ${installed_lock})
  else()
    message(WARNING "The viewer is left out, because npm failed:\n${output}")
    set(${result} "npm failed when it was configured (${status}); configure again" PARENT_SCOPE)
  endif()
endfunction()

# Sets `result` to a source file that defines what view/page_template.h declares.
function(chasles_viewer result)
  set(source ${viewer_work_dir}/page_template.cpp)
  chasles_install_viewer_packages(why_not)
  if(why_not)
    message(STATUS "No viewer: ${why_not}")
    configure_file(${PROJECT_SOURCE_DIR}/cmake/no_page_template.cpp.in ${viewer_work_dir}/no_page_template.cpp @ONLY)
    set(${result} ${viewer_work_dir}/no_page_template.cpp PARENT_SCOPE)
    return()
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${viewer_dir}/*)
  # The sources are copied beside the packages, so that every tool finds these where it looks for them.
  add_custom_command(
    OUTPUT ${source} ${viewer_work_dir}/page_template.html
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${viewer_dir} ${viewer_work_dir}
    COMMAND ${CHASLES_NODE} build.mjs
    DEPENDS ${sources}
    WORKING_DIRECTORY ${viewer_work_dir}
    COMMENT "Bundling the viewer"
    VERBATIM)
  set(${result} ${source} PARENT_SCOPE)
endfunction()
