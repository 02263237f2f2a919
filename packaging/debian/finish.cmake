# What Debian asks of every package and of no other installation: its changelog and copyright, manual pages and changelogs
# compressed, static libraries without what only debuggers read. CPack runs this when the components lie where it packs
# them from.
if(NOT CPACK_GENERATOR STREQUAL DEB)
  return()
endif()

# compress(FILE TARGET): into TARGET, the same bytes whenever it is done.
function(compress file target)
  execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${target} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The licence as a paragraph of a copyright file: every line indented, an empty one a dot.
file(READ ${CMAKE_CURRENT_LIST_DIR}/../../LICENSE licence)
string(REGEX MATCH "Copyright [^\n]*" owner "${licence}")
string(REGEX REPLACE "^.*Copyright [^\n]*\n+" "" licence "${licence}")
string(REGEX REPLACE "\n+$" "" licence "${licence}")
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
string(REGEX REPLACE "^Copyright \\(c\\) " "" owner "${owner}")

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  set(documents ${root}/share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  file(MAKE_DIRECTORY ${documents})
  file(WRITE ${documents}/copyright
    "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: billow\n\n"
    "Files: *\nCopyright: ${owner}\nLicense: Expat\n ${licence}\n")
  compress(${CMAKE_CURRENT_LIST_DIR}/changelog ${documents}/changelog.Debian.gz)
  file(REMOVE ${documents}/LICENSE)
  if(EXISTS ${documents}/CHANGELOG.md)
    compress(${documents}/CHANGELOG.md ${documents}/changelog.gz)
    file(REMOVE ${documents}/CHANGELOG.md)
  endif()
  file(GLOB pages ${root}/share/man/man*/*.[1-9])
  foreach(page IN LISTS pages)
    compress(${page} ${page}.gz)
    file(REMOVE ${page})
  endforeach()
  file(GLOB_RECURSE archives ${root}/lib/*.a)
  foreach(archive IN LISTS archives)
    execute_process(COMMAND strip --strip-debug --enable-deterministic-archives ${archive} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
