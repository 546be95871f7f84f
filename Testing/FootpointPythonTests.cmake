# Tests that are Python programs: Debian's Python runs them with VTK, pvpython with ParaView.
if (FOOTPOINT_USE_PARAVIEW)
  find_program(FOOTPOINT_PVPYTHON pvpython
    HINTS "${ParaView_PREFIX_PATH}/bin" NO_DEFAULT_PATH REQUIRED)
  find_program(FOOTPOINT_PVBATCH pvbatch
    HINTS "${ParaView_PREFIX_PATH}/bin" NO_DEFAULT_PATH REQUIRED)
  find_program(FOOTPOINT_PVSERVER pvserver
    HINTS "${ParaView_PREFIX_PATH}/bin" NO_DEFAULT_PATH REQUIRED)
  set(footpoint_python "${FOOTPOINT_PVPYTHON}")
else ()
  set(footpoint_python "${Python3_EXECUTABLE}")
endif ()
# The vtkmodules of the VTK that we were built against, whatever prefix it is in.
set(footpoint_vtk_python_dir "${VTK_PREFIX_PATH}/${VTK_PYTHONPATH}")

# footpoint_add_python_tests(<prefix> <glob> [argument...]): one ctest <prefix>.<name> for every
# program that matches. A program skips by exiting with 125.
function (footpoint_add_python_tests prefix pattern)
  file(GLOB programs CONFIGURE_DEPENDS "${pattern}")
  foreach (program IN LISTS programs)
    get_filename_component(name "${program}" NAME_WE)
    add_test(NAME "${prefix}.${name}" COMMAND "${footpoint_python}" "${program}" ${ARGN})
    set_tests_properties("${prefix}.${name}" PROPERTIES
      SKIP_RETURN_CODE ${footpoint_skip_code}
      TIMEOUT 300
      ENVIRONMENT "${footpoint_test_environment};FOOTPOINT_TEST_OUTPUT=${footpoint_test_output};PYTHONDONTWRITEBYTECODE=1;PYTHONPATH=${CMAKE_BINARY_DIR}/${footpoint_python_dir}:${footpoint_vtk_python_dir}")
  endforeach ()
endfunction ()
