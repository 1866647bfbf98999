# Warnings are errors in our own code; linked privately, so they reach nobody who uses us.
add_library(gracilis_warnings INTERFACE)
target_compile_options(gracilis_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor $<$<NOT:$<BOOL:${GRACILIS_FUZZ}>>:-Werror>
                       -Wno-restrict)  # GCC 12 reports it falsely in std::string operator+ (GCC bug 105651)
