# Debian's Python looks for what packages install in a folder that all its versions share.
file(GLOB module ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/python/usr/lib/python3.*/dist-packages/dibhr)
if(module)
  cmake_path(GET module PARENT_PATH versioned)
  cmake_path(GET versioned PARENT_PATH python)
  file(MAKE_DIRECTORY ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/python/usr/lib/python3)
  file(RENAME ${versioned} ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/python/usr/lib/python3/dist-packages)
  file(REMOVE_RECURSE ${python})
endif()
