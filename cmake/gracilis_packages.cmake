# `cpack` in a build folder makes gracilis, libgracilis-dev and python3-gracilis (.deb). tools/packages.sh also checks them.
set(GRACILIS_MAINTAINER "Gracilis maintainers <maintainers@gracilis.example>" CACHE STRING "Who answers for the packages")

set(package_files ${PROJECT_BINARY_DIR}/packaging)
if(TARGET gracilis_prepare)
  string(CONCAT GRACILIS_COPYRIGHT_COMMENT "The program and the Python package contain 'prepare', which uses CGAL (GPL-3+):\n"
         " as a whole they are under the GNU General Public License, version 3 or later,\n"
         " whose text is in /usr/share/common-licenses/GPL-3.")
else()
  set(GRACILIS_COPYRIGHT_COMMENT "Built without 'prepare': nothing here is under the GPL.")
endif()
configure_file(${PROJECT_SOURCE_DIR}/packaging/copyright.in ${package_files}/copyright @ONLY)

# Reproducible: the date of the newest commit, or SOURCE_DATE_EPOCH.
set(package_date "Thu, 01 Jan 1970 00:00:00 +0000")
find_program(GRACILIS_GIT git)
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND date -u -R -d @$ENV{SOURCE_DATE_EPOCH} OUTPUT_VARIABLE package_date OUTPUT_STRIP_TRAILING_WHITESPACE)
elseif(GRACILIS_GIT)
  execute_process(COMMAND ${GRACILIS_GIT} -C ${PROJECT_SOURCE_DIR} log -1 --format=%cD OUTPUT_VARIABLE said ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(said)
    set(package_date ${said})
  endif()
endif()
file(CONFIGURE OUTPUT ${package_files}/changelog @ONLY CONTENT
"gracilis (@PROJECT_VERSION@) unstable; urgency=medium

  * Everything that changed is in CHANGELOG.md of the sources.

 -- @GRACILIS_MAINTAINER@  @package_date@
")
execute_process(COMMAND gzip -9nkf ${package_files}/changelog)

# Installed by packages alone: a folder of documents for each, as Debian has them.
function(gracilis_package component package)
  install(FILES ${package_files}/copyright ${package_files}/changelog.gz DESTINATION share/doc/${package}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()
gracilis_package(program gracilis)
gracilis_package(dev libgracilis-dev)
install(FILES ${PROJECT_SOURCE_DIR}/packaging/gracilis.desktop DESTINATION share/applications COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/packaging/gracilis.xml DESTINATION share/mime/packages COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/packaging/gracilis.svg DESTINATION share/icons/hicolor/scalable/apps COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gracilis)
set(CPACK_PACKAGE_CONTACT ${GRACILIS_MAINTAINER})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program core toolkit dev)
set(CPACK_COMPONENT_PROGRAM_GROUP program)
foreach(component CORE TOOLKIT DEV)
  set(CPACK_COMPONENT_${component}_GROUP dev)
endforeach()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gracilis)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libgl1-mesa-dri")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, python3-gracilis")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Bones, muscle surfaces and a motion become deforming, contracting muscles,
with their fibers, moment arms and forces. This package has the program
gracilis, its manual and completions for bash, zsh and fish.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libgracilis-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
string(CONCAT CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libtbb-dev, libembree-dev, libhwy-dev, libnanoflann-dev, "
       "libqhull-dev, libvtk9-dev, libtomlplusplus-dev, nlohmann-json3-dev, libspdlog-dev, libfmt-dev, libssl-dev, "
       "libegl-dev, libx11-dev, libpugixml-dev, libgif-dev, libtinygltf-dev, libdraco-dev, libsimbody-dev, libmuparser-dev, "
       "libnlopt-cxx-dev, libhdf5-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Headers, static libraries and CMake files for programs that deform muscles
of musculoskeletal models: find_package(gracilis) brings gracilis::core and
gracilis::toolkit.")

if(GRACILIS_WITH_PYTHON)
  gracilis_package(python python3-gracilis)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_COMPONENT_PYTHON_GROUP python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-gracilis)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "gracilis, python3-matplotlib, python3-vtk9")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Bones, muscle surfaces and a motion become deforming, contracting muscles,
as NumPy arrays: simulations, moment arms, runs and OpenSim models.")
endif()
include(CPack)
