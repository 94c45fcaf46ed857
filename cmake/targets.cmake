# What every target of the project has in common.

# Floating-point rules, warnings and checks of a target of the project. They never reach those who link to it.
function(chasles_strict target)
  # Error bounds are derived for separately rounded operations, and answers must not depend on the machine. See
  # docs/decisions/0001-contraction-off.md.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wno-psabi $<$<BOOL:${CHASLES_WERROR}>:-Werror>)
  if(CHASLES_CHECKS)
    # Bounds of the standard containers; assert() itself is switched on by leaving NDEBUG out (see the presets).
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  endif()
endfunction()

# With CHASLES_UNITY, sources of a target are compiled together: most of the time goes into headers that all of them read.
# Names in anonymous namespaces are then unique in the target. -Wshadow would compare names with those of other sources, and
# GCC warns of what it inlines from one source into another.
function(chasles_unity target)
  if(CHASLES_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-error>)
  endif()
endfunction()
