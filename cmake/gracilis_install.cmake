# What find_package(gracilis) reads. The libraries install themselves and their headers in src/CMakeLists.txt.
include(CMakePackageConfigHelpers)

set(gracilis_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gracilis)
string(REPLACE ";" " " GRACILIS_VTK_COMPONENT_LIST "${GRACILIS_VTK_COMPONENTS};${GRACILIS_VTK_WINDOW_COMPONENTS}")
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gracilisConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/gracilisConfig.cmake
                              INSTALL_DESTINATION ${gracilis_package_folder} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gracilisConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gracilisConfig.cmake ${PROJECT_BINARY_DIR}/gracilisConfigVersion.cmake
        DESTINATION ${gracilis_package_folder} COMPONENT dev)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)
