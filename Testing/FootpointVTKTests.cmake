# VTK's C++ tests, `int TestX(int, char*[])` in TestX.cxx: one executable, one ctest a file, named
# <prefix>.TestX. Every test gets -T <folder to write in> and -V <baseline picture>; a test that
# renders ends with vtkRegressionTestImage. The picture of a first run stands in the folder of -T.
# Not vtk_add_test_cxx: it works only inside vtk_module_build, and makes the module depend on the
# rendering modules of its tests.

# Sets CMAKE_TESTDRIVER_BEFORE_TESTMAIN: reads -T and -V, replaces the interactor.
set(_vtk_build_TEST_OUTPUT_DIRECTORY "${footpoint_test_output}")
include("${VTK_DIR}/vtkTestingRenderingDriver.cmake")

# footpoint_add_vtk_tests(<prefix> LIBRARIES <target>... MODULES <VTK module>...): all Test*.cxx of
# the folder.
function (footpoint_add_vtk_tests prefix)
  cmake_parse_arguments(PARSE_ARGV 1 tests "" "" "LIBRARIES;MODULES")
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" Test*.cxx)
  # What the driver itself needs.
  list(APPEND tests_MODULES
    VTK::InteractionStyle VTK::RenderingFreeType VTK::RenderingOpenGL2 VTK::TestingCore
    VTK::TestingRendering)

  set(program "vtkFootpoint${prefix}CxxTests")
  create_test_sourcelist(driver_and_tests "${program}.cxx" ${sources}
    EXTRA_INCLUDE vtkTestingObjectFactory.h)
  add_executable("${program}" ${driver_and_tests})
  target_link_libraries("${program}" PRIVATE ${tests_LIBRARIES} ${tests_MODULES})
  vtk_module_autoinit(
    TARGETS "${program}"
    MODULES ${tests_MODULES})
  set_property(SOURCE ${sources} APPEND PROPERTY COMPILE_OPTIONS ${footpoint_vtk_warnings})

  foreach (source IN LISTS sources)
    get_filename_component(name "${source}" NAME_WE)
    add_test(NAME "${prefix}.${name}"
      COMMAND "${program}" "${name}"
        -T "${footpoint_test_output}"
        -V "${CMAKE_SOURCE_DIR}/Data/Baseline/${name}.png")
    set_tests_properties("${prefix}.${name}" PROPERTIES
      ENVIRONMENT "${footpoint_test_environment}"
      SKIP_RETURN_CODE ${footpoint_skip_code}
      # vtkErrorMacro, vtkDebugLeaks and vtkTesting
      FAIL_REGULAR_EXPRESSION
        "(\n|^)ERROR: ;ERR\\|;instances? still around;Failed Image Test;name=.ImageNotFound")
  endforeach ()
endfunction ()
