# Every package comes from Debian 12; each is used behind one adapter (docs/architecture.md).
find_package(Boost 1.74 CONFIG REQUIRED)
find_package(Eigen3 CONFIG REQUIRED)
find_package(NLopt CONFIG REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(Threads REQUIRED)
include(${CMAKE_CURRENT_LIST_DIR}/lemon.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/clp.cmake)

# Headers only: a consumer of the installed library never needs the first three.
set(NDA_DEPENDENCIES
  $<BUILD_INTERFACE:Boost::headers> $<BUILD_INTERFACE:Eigen3::Eigen>
  $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>
  NLopt::nlopt TBB::tbb ZLIB::ZLIB nda::lemon nda::clp Threads::Threads)
