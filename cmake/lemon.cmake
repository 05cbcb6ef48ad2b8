# Debian's LEMON sets variables only; here it becomes the target nda::lemon.
# Read by our own build and, installed beside it, by nda-config.cmake.
if(NOT TARGET nda::lemon)
  find_package(lemon CONFIG REQUIRED)
  add_library(nda::lemon UNKNOWN IMPORTED)
  set_target_properties(nda::lemon PROPERTIES
    IMPORTED_LOCATION "${LEMON_LIBRARIES}"
    INTERFACE_INCLUDE_DIRECTORIES "${LEMON_INCLUDE_DIRS}")
endif()
