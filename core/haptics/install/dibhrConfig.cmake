# find_package(dibhr): dibhr::haptics_static, dibhr::haptics_shared, and dibhr::haptics, which is the shared one
# if the component `shared` is asked for or BUILD_SHARED_LIBS is on, else the static one.
include(CMakeFindDependencyMacro)
if(NOT TARGET glm::glm)
  find_dependency(glm)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/dibhrTargets.cmake)

set(dibhr_static_FOUND TRUE)
set(dibhr_shared_FOUND TRUE)
foreach(component ${dibhr_FIND_COMPONENTS})
  if(NOT dibhr_${component}_FOUND AND dibhr_FIND_REQUIRED_${component})
    set(dibhr_FOUND FALSE)
    set(dibhr_NOT_FOUND_MESSAGE "dibhr has no component ${component}: static or shared")
  endif()
endforeach()

if(NOT TARGET dibhr::haptics)
  if("shared" IN_LIST dibhr_FIND_COMPONENTS OR (BUILD_SHARED_LIBS AND NOT "static" IN_LIST dibhr_FIND_COMPONENTS))
    add_library(dibhr::haptics ALIAS dibhr::haptics_shared)
  else()
    add_library(dibhr::haptics ALIAS dibhr::haptics_static)
  endif()
endif()
