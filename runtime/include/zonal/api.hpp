#pragma once

/// Marks what the libraries let others call; everything else stays hidden in a shared library
/// (BUILD_SHARED_LIBS). On Windows CMake exports every symbol (WINDOWS_EXPORT_ALL_SYMBOLS).
#if defined(__GNUC__) && !defined(_WIN32)
#define ZONAL_API __attribute__((visibility("default")))
#else
#define ZONAL_API
#endif
