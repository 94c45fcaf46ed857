# The public headers are chasles/chasles.h and whatever it includes, found by reading the includes: nobody has to keep a
# list, and nothing internal is installed.

# Sets `result` to the absolute paths of `root_header` (relative to the project) and all headers it reaches.
function(chasles_public_headers root_header result)
  set(waiting ${root_header})
  set(found "")
  while(waiting)
    list(POP_FRONT waiting header)
    set(path ${PROJECT_SOURCE_DIR}/${header})
    if(path IN_LIST found OR NOT EXISTS ${path})
      continue()
    endif()
    list(APPEND found ${path})
    # A new include must reach the list without anyone thinking of configuring again.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    file(STRINGS ${path} includes REGEX "^[ \t]*#[ \t]*include[ \t]*\"chasles/")
    list(TRANSFORM includes REPLACE ".*\"(.*)\".*" "\\1")
    list(APPEND waiting ${includes})
  endwhile()
  set(${result} ${found} PARENT_SCOPE)
endfunction()
