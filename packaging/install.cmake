# What `cmake --install` puts where: the tool with its manual page and completions, the scenes with the meshes, textures
# and schema that they name, the libraries with their headers, the documents. Nothing that is installed holds the path of
# its prefix, so that the whole can be moved; paths follow GNUInstallDirs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(packaging/public_headers.cmake)

# The components: billow (what runs), development (what is compiled against), documents.
set(BILLOW_DATA ${CMAKE_INSTALL_DATADIR}/billow)
set(BILLOW_GENERATED ${CMAKE_BINARY_DIR}/generated)
install(TARGETS billow RUNTIME COMPONENT billow)

# The tool writes its manual page and completions itself, from the table that its help is made from.
function(billow_generates kind file destination)
  add_custom_command(OUTPUT ${BILLOW_GENERATED}/${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${BILLOW_GENERATED}
    COMMAND billow generate ${kind} > ${BILLOW_GENERATED}/${file}
    DEPENDS billow VERBATIM)
  install(FILES ${BILLOW_GENERATED}/${file} DESTINATION ${destination} COMPONENT billow)
  set_property(DIRECTORY APPEND PROPERTY BILLOW_GENERATED_FILES ${BILLOW_GENERATED}/${file})
endfunction()
billow_generates(man billow.1 ${CMAKE_INSTALL_MANDIR}/man1)
billow_generates(bash billow ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
billow_generates(zsh _billow ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
billow_generates(fish billow.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
get_directory_property(BILLOW_GENERATED_FILES BILLOW_GENERATED_FILES)
add_custom_target(billow_generated ALL DEPENDS ${BILLOW_GENERATED_FILES})
# All that is installed, and nothing else.
add_custom_target(installed DEPENDS billow billow_generated billow_drawn)

# Scenes name their meshes as ../assets, so the two stay neighbours.
install(DIRECTORY scenes DESTINATION ${BILLOW_DATA} COMPONENT billow
  FILES_MATCHING PATTERN "*.yaml" PATTERN "*.json")
install(DIRECTORY assets/meshes assets/textures DESTINATION ${BILLOW_DATA}/assets COMPONENT billow
  FILES_MATCHING PATTERN "*.obj" PATTERN "*.png")
install(FILES assets/CREDITS.md DESTINATION ${BILLOW_DATA}/assets COMPONENT billow)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT billow)

# Documents keep their places beside each other, as their links have them.
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.py")

# The libraries, and the headers in which nothing is seen that a library keeps to itself.
set(BILLOW_LIBRARIES billow_drawn billow_scene billow_render billow_image billow_sim billow_base)
install(TARGETS ${BILLOW_LIBRARIES} EXPORT billow ARCHIVE COMPONENT development
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/billow)
billow_public_headers(BILLOW_HEADERS base sim render cli/text cli/yaml cli/scene cli/drawn)
foreach(header IN LISTS BILLOW_HEADERS)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/billow/${folder} COMPONENT development)
endforeach()

# A program's own code rounds as the libraries' does: both have the same templates in them.
target_compile_options(billow_base INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
foreach(library IN LISTS BILLOW_LIBRARIES)
  string(REPLACE billow_ "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()

# Packages without a CMake file of their own, under the names by which CMakeLists.txt knows them.
set(BILLOW_PKG_CONFIG ZIP libzip CAIRO cairo MUPARSER muparser HIGHWAY libhwy)
set(BILLOW_FIND_MODULES "")
while(BILLOW_PKG_CONFIG)
  list(POP_FRONT BILLOW_PKG_CONFIG name module)
  if(${name}_FOUND)
    string(APPEND BILLOW_FIND_MODULES "pkg_check_modules(${name} QUIET REQUIRED IMPORTED_TARGET ${module})\n")
    string(APPEND BILLOW_PC_MODULES " ${module}")
  endif()
endwhile()

set(BILLOW_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/billow)
install(EXPORT billow NAMESPACE billow:: FILE billowTargets.cmake DESTINATION ${BILLOW_CMAKE} COMPONENT development)
configure_package_config_file(packaging/billowConfig.cmake.in ${BILLOW_GENERATED}/billowConfig.cmake
  INSTALL_DESTINATION ${BILLOW_CMAKE} NO_SET_AND_CHECK_MACRO)
# What 0.x promises holds within a minor version.
write_basic_package_version_file(${BILLOW_GENERATED}/billowConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${BILLOW_GENERATED}/billowConfig.cmake ${BILLOW_GENERATED}/billowConfigVersion.cmake
  DESTINATION ${BILLOW_CMAKE} COMPONENT development)

# Where the prefix is, pkg-config finds from where the file is.
file(RELATIVE_PATH BILLOW_PREFIX_FROM_PC ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
get_target_property(BILLOW_DEFINITIONS billow_base INTERFACE_COMPILE_DEFINITIONS)
list(TRANSFORM BILLOW_DEFINITIONS PREPEND -D)
list(JOIN BILLOW_DEFINITIONS " " BILLOW_DEFINITIONS)
configure_file(packaging/billow.pc.in ${BILLOW_GENERATED}/billow.pc @ONLY)
install(FILES ${BILLOW_GENERATED}/billow.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

include(packaging/package.cmake)
