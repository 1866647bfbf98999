# Warnings are errors in our own code; linked privately, so they reach nobody who uses us.
# Where files are compiled together, a local name may well be that of another file's function.
add_library(gracilis_warnings INTERFACE)
target_compile_options(gracilis_warnings INTERFACE -Wall -Wextra -Wpedantic $<IF:$<BOOL:${CMAKE_UNITY_BUILD}>,-Wshadow=local,-Wshadow> -Wnon-virtual-dtor -Werror
                       -Wno-restrict)  # GCC 12 reports it falsely in std::string operator+ (GCC bug 105651)
