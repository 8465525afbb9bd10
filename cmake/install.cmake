# cmake --install, and a Debian package by `cpack` in the build folder. Libraries are found by dpkg-shlibdeps.
include(GNUInstallDirs)

install(DIRECTORY resources/sample DESTINATION ${CMAKE_INSTALL_DATADIR}/pellucid)
install(FILES packaging/pellucid.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES packaging/pellucid.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "Pellucid contributors <pellucid@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "workstation for volume data such as CT and MR scans")
set(CPACK_PACKAGE_DESCRIPTION
    "Pellucid draws scalar volumes by ray casting with OpenGL and says with every picture how long it took and how wrong it is. It has a desktop with linked views and a command line. It is not a medical device.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl-mesa0, libgl1-mesa-dri, fonts-dejavu-core")
include(CPack)
