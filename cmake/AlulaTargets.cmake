# One place that knows how Alula's targets are compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(PkgConfig REQUIRED)

# The floating-point contract (DESIGN section 4): no contraction, no fast-math, no -march=native.
add_library(alula_options INTERFACE)
target_compile_options(alula_options INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wconversion
  -Wno-sign-conversion -Werror)
# GCC 12 at -O3 sees overlaps in `"text" + std::string` that are not there (GCC bug 105651), and its other guesses from
# data flow change with the optimisation level: they inform, they do not stop a build.
target_compile_options(alula_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-error=maybe-uninitialized
  -Wno-error=array-bounds -Wno-error=stringop-overflow -Wno-error=stringop-overread>)
target_include_directories(alula_options INTERFACE ${CMAKE_SOURCE_DIR})
target_include_directories(alula_options SYSTEM INTERFACE ${EIGEN3_INCLUDE_DIRS})
# A vector that nobody has set is zero, in every build: a forgotten one must not make two runs differ.
target_compile_definitions(alula_options INTERFACE EIGEN_DONT_PARALLELIZE EIGEN_INITIALIZE_MATRICES_BY_ZERO)

# libFuzzer programs (tests/fuzz): all of our code counts coverage and is watched by the sanitizers.
option(ALULA_FUZZ "Build libFuzzer programs (clang only)" OFF)
if(ALULA_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "ALULA_FUZZ needs clang: CXX=clang++ cmake …")
  endif()
  target_compile_options(alula_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  target_link_options(alula_options INTERFACE -fsanitize=address,undefined)
endif()

# alula_library(NAME SOURCES … LINKS … SYSTEM_INCLUDES …): one folder, one target, explicit dependencies.
function(alula_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS;SYSTEM_INCLUDES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC alula_options ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  target_include_directories(${name} SYSTEM PRIVATE ${ARG_SYSTEM_INCLUDES})
endfunction()

# alula_test(NAME SOURCES … LINKS … LABEL unit|scenario|data|slow): one GoogleTest program, each case its own CTest test.
function(alula_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LINKS;SYSTEM_INCLUDES" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  find_package(GTest REQUIRED)
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE alula_options ${ARG_LINKS} GTest::gtest GTest::gtest_main)
  target_include_directories(${name} SYSTEM PRIVATE ${ARG_SYSTEM_INCLUDES})
  include(GoogleTest)
  gtest_discover_tests(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} DISCOVERY_TIMEOUT 60
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endfunction()
