# Debian's CLP has no CMake package; here it becomes the target nda::clp.
# Read by our own build and, installed beside it, by nda-config.cmake.
if(NOT TARGET nda::clp)
  find_library(NDA_CLP_LIBRARY Clp REQUIRED)
  find_library(NDA_COINUTILS_LIBRARY CoinUtils REQUIRED)
  find_path(NDA_CLP_INCLUDE_DIR coin/ClpSimplex.hpp REQUIRED)
  add_library(nda::clp UNKNOWN IMPORTED)
  set_target_properties(nda::clp PROPERTIES
    IMPORTED_LOCATION "${NDA_CLP_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${NDA_CLP_INCLUDE_DIR};${NDA_CLP_INCLUDE_DIR}/coin"
    INTERFACE_LINK_LIBRARIES "${NDA_COINUTILS_LIBRARY}")
endif()
