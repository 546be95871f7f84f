# inversion_benchmark: ours beside other programs, each of which is optional.
add_executable(inversion_benchmark
  benchmark_shapes.cpp comparison.cpp figures.cpp inversion_benchmark.cpp peer_footpoint.cpp
  queries.cpp results.cpp scaling.cpp tables.cpp vector_targets.cpp)
# Shapes and the brute force that the tests have too.
set(tests "${CMAKE_SOURCE_DIR}/Testing/Core")
target_sources(inversion_benchmark PRIVATE "${tests}/Oracle.cpp" "${tests}/OracleNearest.cpp"
  "${tests}/OracleShapes.cpp" "${tests}/Shapes.cpp")
target_include_directories(inversion_benchmark PRIVATE "${tests}")
find_package(hwy 1.0 REQUIRED CONFIG) # to choose vector instructions
target_link_libraries(inversion_benchmark PRIVATE Footpoint::Core hwy::hwy)
target_compile_options(inversion_benchmark PRIVATE ${footpoint_vtk_warnings})

set(footpoint_peers)
find_package(OpenCASCADE QUIET COMPONENTS FoundationClasses ModelingData ModelingAlgorithms)
if (TARGET TKShHealing AND TARGET TKG3d)
  list(APPEND footpoint_peers OCCT)
  target_sources(inversion_benchmark PRIVATE peer_occt.cpp)
  target_include_directories(inversion_benchmark SYSTEM PRIVATE "${OpenCASCADE_INCLUDE_DIR}")
  target_link_libraries(inversion_benchmark PRIVATE TKShHealing TKG3d TKMath TKernel)
  target_compile_definitions(inversion_benchmark PRIVATE BENCHMARK_OCCT)
endif ()

find_path(SISL_INCLUDE_DIR sisl.h)
find_library(SISL_LIBRARY sisl)
if (SISL_INCLUDE_DIR AND SISL_LIBRARY)
  list(APPEND footpoint_peers SISL)
  target_sources(inversion_benchmark PRIVATE peer_sisl.cpp)
  target_include_directories(inversion_benchmark SYSTEM PRIVATE "${SISL_INCLUDE_DIR}")
  target_link_libraries(inversion_benchmark PRIVATE "${SISL_LIBRARY}")
  target_compile_definitions(inversion_benchmark PRIVATE BENCHMARK_SISL)
endif ()

if (NOT FOOTPOINT_CORE_ONLY)
  list(APPEND footpoint_peers "VTK")
  target_sources(inversion_benchmark PRIVATE filter_timing.cpp peer_vtk_locator.cpp)
  target_link_libraries(inversion_benchmark PRIVATE
    Footpoint::Filters VTK::CommonCore VTK::CommonDataModel VTK::CommonExecutionModel)
  target_compile_definitions(inversion_benchmark PRIVATE BENCHMARK_VTK)
endif ()
list(JOIN footpoint_peers ", " footpoint_peers)
if (NOT footpoint_peers)
  set(footpoint_peers "no other program")
endif ()
message(STATUS "Footpoint: inversion_benchmark compares with ${footpoint_peers}")

# Too few points for figures: only that it runs, from the first shape to the last.
if (BUILD_TESTING)
  add_test(NAME "Benchmarks.inversion"
    COMMAND inversion_benchmark --points 20 --budget 0.001 --repeats 1
      --output "${CMAKE_BINARY_DIR}/Testing/Temporary")
endif ()

# cad_benchmark: the filter on CAD models beside Open CASCADE and VTK's cell locator.
if (FOOTPOINT_WITH_OCCT AND NOT FOOTPOINT_CORE_ONLY)
  add_executable(cad_benchmark cad_benchmark.cpp cad_models.cpp)
  target_link_libraries(cad_benchmark PRIVATE
    Footpoint::Filters Footpoint::IO footpointCAD VTK::CommonCore VTK::CommonDataModel
    VTK::CommonExecutionModel)
  target_compile_options(cad_benchmark PRIVATE ${footpoint_vtk_warnings})
  # What it needs at run time only: the program that reads the files.
  add_dependencies(cad_benchmark footpoint-read-cad)
  # Too few points for figures: only that it runs.
  set(cad_benchmark_file "/usr/share/opencascade/data/iges/bearing.iges")
  if (BUILD_TESTING AND EXISTS "${cad_benchmark_file}")
    add_test(NAME "Benchmarks.cad"
      COMMAND cad_benchmark --points 50 --occt-points 2 --output
        "${CMAKE_BINARY_DIR}/Testing/Temporary" "${cad_benchmark_file}")
  endif ()
endif ()
