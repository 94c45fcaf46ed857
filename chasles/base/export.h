// The macro for symbols that a shared library of Chasles exports. All other symbols are hidden.
// On Windows it depends on CHASLES_BUILDS_SHARED and CHASLES_USES_SHARED.
#pragma once

#if defined(_WIN32)
#if defined(CHASLES_BUILDS_SHARED)
#define CHASLES_EXPORT __declspec(dllexport)
#elif defined(CHASLES_USES_SHARED)
#define CHASLES_EXPORT __declspec(dllimport)
#else
#define CHASLES_EXPORT
#endif
#else
#define CHASLES_EXPORT __attribute__((visibility("default")))
#endif
