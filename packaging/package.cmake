# What `cpack -G DEB` makes: billow, libbillow-dev and billow-doc.
set(CPACK_PACKAGE_CONTACT "the billow authors <billow@example.org>" CACHE STRING "Who maintains the packages")
set(CPACK_PACKAGE_VENDOR billow)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each component's description begins with its own
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL billow development documents)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/debian/finish.cmake)

# What the tool links is found by dpkg-shlibdeps; the rest it opens while it runs: either of the two ways to draw without
# a display, the font of labels, gnuplot for plots, ffmpeg for films.
set(CPACK_DEBIAN_BILLOW_PACKAGE_NAME billow)
set(CPACK_DEBIAN_BILLOW_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_BILLOW_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_BILLOW_PACKAGE_DEPENDS
  "libosmesa6 | libegl1, libosmesa6 | libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_DEBIAN_BILLOW_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, ffmpeg")
set(CPACK_DEBIAN_BILLOW_PACKAGE_SUGGESTS "billow-doc, libbillow-dev")
set(CPACK_COMPONENT_BILLOW_DESCRIPTION "filtered mass-spring cloth and fish, rendered offscreen
billow simulates cloth and fish as filtered mass-spring systems from scene
files in YAML and renders them to PNG without a display: textured and
velocity-coloured frames, velocity-evolution strips, certified step limits.

It brings scenes, meshes and textures to begin with.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbillow-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libtbb-dev, libfmt-dev, libzip-dev, libassimp-dev, libpng-dev, libjpeg-dev, zlib1g-dev, \
libopenexr-dev, libyaml-cpp-dev, libmuparser-dev, libcairo2-dev, libhwy-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "filtered mass-spring cloth and fish, static libraries
Libraries and headers that read billow's scenes, step them and draw their
frames, for programs of one's own, which find them by CMake's
find_package(billow) or by pkg-config.")

set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_NAME billow-doc)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOCUMENTS_DESCRIPTION "filtered mass-spring cloth and fish, documents
What billow's scenes and studies can say, the method and its equations, what
was measured, with pictures.")

include(CPack)
