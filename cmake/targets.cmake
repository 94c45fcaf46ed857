# What every target of the project has in common.

# Warnings and checks of a target of the project. They never reach those who link to it.
function(chasles_strict target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wno-psabi $<$<BOOL:${CHASLES_WERROR}>:-Werror>)
  if(CHASLES_CHECKS)
    # Bounds of the standard containers; assert() itself is switched on by leaving NDEBUG out (see the presets).
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  endif()
endfunction()
