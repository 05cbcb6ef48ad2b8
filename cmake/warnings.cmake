# Warnings for our own targets only; consumers never see them.
add_library(nda_warnings INTERFACE)
target_compile_options(nda_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror=return-type
  -ffp-contract=off)
