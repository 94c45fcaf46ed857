# What every target of the project has in common.

# Floating-point rules, warnings and checks of a target of the project. They never reach those who link to it.
function(chasles_strict target)
  # Error bounds are derived for separately rounded operations, and answers must not depend on the machine. See
  # docs/decisions/0001-contraction-off.md.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wno-psabi $<$<BOOL:${CHASLES_WERROR}>:-Werror>)
  if(NOT CHASLES_UNITY AND NOT CMAKE_UNITY_BUILD) # names of other sources are in sight there
    target_compile_options(${target} PRIVATE -Wshadow)
  endif()
  if(CHASLES_CHECKS)
    # Bounds of the standard containers; assert() itself is switched on by leaving NDEBUG out (see the presets).
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  endif()
endfunction()

# With CHASLES_UNITY, sources of a target are compiled together: most of the time goes into headers that all of them read.
# Names in anonymous namespaces are then unique in the target. GCC warns of what it inlines from one source into another,
# so warnings are errors only where sources are compiled alone.
function(chasles_unity target)
  if(CHASLES_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    target_compile_options(${target} PRIVATE -Wno-error)
  endif()
endfunction()
