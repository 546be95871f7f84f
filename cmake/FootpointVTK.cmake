# Everything that needs VTK: the modules Footpoint::Filters and Footpoint::IO, their Python package and
# the ParaView plugin.

# --- VTK: either flavour defines the VTK:: targets and the vtk_module_* functions. Always with
# COMPONENTS: without, every optional third party is demanded. The first three lines hold every module
# that Filters/vtk.module and IO/vtk.module name.
set(vtk_components
  CommonCore CommonDataModel CommonExecutionModel CommonComputationalGeometry ParallelCore
  IOCore IOXMLParser expat jsoncpp vtksys
  Python WrappingPythonCore)
# Ranks tell each other at once to stop; without MPI there is one rank anyway.
set(vtk_optional_components ParallelMPI)
if (BUILD_TESTING)
  list(APPEND vtk_components
    FiltersCore FiltersExtraction FiltersGeneral FiltersGeometry FiltersSources ImagingCore
    InteractionStyle IOImage IOXML RenderingAnnotation RenderingFreeType RenderingOpenGL2 TestingCore
    TestingRendering)
endif ()
if (FOOTPOINT_USE_PARAVIEW)
  # The hints are where Utilities/set_up.sh unpacks ParaView.
  set(CMAKE_WARN_DEPRECATED OFF) # ParaView's own files use old names of its components
  find_package(ParaView 5.11 REQUIRED
    COMPONENTS RemotingCore RemotingServerManager RemotingViews WrapClientServer ProcessXML
    HINTS "$ENV{FOOTPOINT_PARAVIEW_ROOT}/usr" "$ENV{XDG_CACHE_HOME}/footpoint/paraview-5.11/usr"
          "$ENV{HOME}/.cache/footpoint/paraview-5.11/usr")
  unset(CMAKE_WARN_DEPRECATED)
  find_package(VTK REQUIRED
    COMPONENTS ${vtk_components}
    OPTIONAL_COMPONENTS ${vtk_optional_components}
    PATHS "${ParaView_DIR}/vtk" NO_DEFAULT_PATH)
else ()
  find_package(VTK 9.1 REQUIRED
    COMPONENTS ${vtk_components}
    OPTIONAL_COMPONENTS ${vtk_optional_components})
endif ()
message(STATUS "Footpoint: VTK ${VTK_VERSION} from ${VTK_DIR}, SMP ${VTK_SMP_BACKENDS}")

# --- The VTK modules
vtk_module_find_modules(module_files "${CMAKE_SOURCE_DIR}/Filters" "${CMAKE_SOURCE_DIR}/IO")
vtk_module_scan(
  MODULE_FILES     ${module_files}
  REQUEST_MODULES  Footpoint::Filters Footpoint::IO
  PROVIDES_MODULES footpoint_modules
  REQUIRES_MODULES footpoint_required_modules
  ENABLE_TESTS     OFF) # Testing/ is a folder of its own

vtk_module_build(
  MODULES             ${footpoint_modules}
  PACKAGE             Footpoint
  INSTALL_EXPORT      Footpoint
  INSTALL_HEADERS     ON
  HEADERS_DESTINATION "${footpoint_include_dir}"
  CMAKE_DESTINATION   "${footpoint_cmake_dir}"
  VERSION             "${PROJECT_VERSION}"
  SOVERSION           1 # 0 counts as unset
  TEST_DIRECTORY_NAME NONE
  ENABLE_WRAPPING     ON)

# --- Python package "footpoint": wrapped modules and our own Python files beside each other
vtk_module_wrap_python(
  MODULES             ${footpoint_modules}
  TARGET              Footpoint::PythonWrapped
  PYTHON_PACKAGE      "footpoint"
  MODULE_DESTINATION  "${footpoint_python_dir}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INSTALL_HEADERS     OFF # a header to load static modules, which these are not
  INSTALL_EXPORT      Footpoint)
add_subdirectory(Wrapping/Python)

# --- ParaView plugin around the same modules
if (FOOTPOINT_USE_PARAVIEW)
  # A module of its own package: it is for the client alone, neither wrapped for Python nor found by
  # find_package(Footpoint).
  vtk_module_scan(
    MODULE_FILES     "${CMAKE_SOURCE_DIR}/Wrapping/ParaView/ServerManager/vtk.module"
    REQUEST_MODULES  Footpoint::ServerManager
    PROVIDES_MODULES footpoint_client_modules
    ENABLE_TESTS     OFF)
  vtk_module_build(
    MODULES             ${footpoint_client_modules}
    PACKAGE             FootpointServerManager
    INSTALL_HEADERS     OFF
    VERSION             "${PROJECT_VERSION}"
    SOVERSION           1
    TEST_DIRECTORY_NAME NONE)
  set(footpoint_plugin_subdir
    "paraview-${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}/plugins")
  paraview_plugin_scan(
    PLUGIN_FILES      "${CMAKE_SOURCE_DIR}/Wrapping/ParaView/Footpoint/paraview.plugin"
    PROVIDES_PLUGINS  footpoint_plugins
    REQUIRES_MODULES  plugin_required_modules
    ENABLE_BY_DEFAULT ON)
  paraview_plugin_build(
    PLUGINS              ${footpoint_plugins}
    TARGET               footpoint_paraview_plugins
    INSTALL_HEADERS      OFF # as above
    LIBRARY_SUBDIRECTORY "${footpoint_plugin_subdir}"
    PLUGINS_FILE_NAME    "footpoint.plugins.xml"
    AUTOLOAD             ${footpoint_plugins})
endif ()

# What FootpointConfig.cmake has to find: the VTK modules ours link to, also privately.
list(FILTER footpoint_required_modules INCLUDE REGEX "^VTK::")
if (TARGET VTK::ParallelMPI)
  list(APPEND footpoint_required_modules VTK::ParallelMPI)
endif ()
list(TRANSFORM footpoint_required_modules REPLACE "^VTK::" "")
list(JOIN footpoint_required_modules " " footpoint_vtk_components)
