# Every package comes from Debian 12; each is used behind one adapter (docs/architecture.md).
find_package(Boost 1.74 CONFIG REQUIRED)
find_package(Eigen3 CONFIG REQUIRED)
find_package(NLopt CONFIG REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(Threads REQUIRED)

find_package(lemon CONFIG REQUIRED)
add_library(nda_lemon INTERFACE)
target_include_directories(nda_lemon SYSTEM INTERFACE ${LEMON_INCLUDE_DIRS})
target_link_libraries(nda_lemon INTERFACE ${LEMON_LIBRARIES})

set(NDA_DEPENDENCIES
  $<BUILD_INTERFACE:Boost::headers> $<BUILD_INTERFACE:Eigen3::Eigen>
  $<BUILD_INTERFACE:NLopt::nlopt> $<BUILD_INTERFACE:TBB::tbb> $<BUILD_INTERFACE:ZLIB::ZLIB>
  $<BUILD_INTERFACE:nlohmann_json::nlohmann_json> $<BUILD_INTERFACE:fmt::fmt>
  $<BUILD_INTERFACE:nda_lemon> $<BUILD_INTERFACE:Threads::Threads>)
