# Puts the text of shader files into a header, so that the program looks for none at run time.
# dibhr_embed_shaders(header a.vert b.frag): a constant kAVert, kBFrag for each.
function(dibhr_embed_shaders header)
  set(constants "")
  foreach(path ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    file(READ ${path} text)
    get_filename_component(stem ${path} NAME_WE)
    get_filename_component(stage ${path} EXT)
    string(SUBSTRING ${stage} 1 -1 stage)
    set(name k)
    foreach(word ${stem} ${stage})
      string(SUBSTRING ${word} 0 1 first)
      string(SUBSTRING ${word} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND name ${first}${rest})
    endforeach()
    string(APPEND constants
           "inline constexpr std::string_view ${name} = R\"glsl(${text})glsl\";\n\n")
  endforeach()
  file(CONFIGURE OUTPUT ${header} @ONLY CONTENT
"// Made by CMake from the shader files; change those.
#pragma once

#include <string_view>

namespace dibhr::shaders {

@constants@}  // namespace dibhr::shaders
")
endfunction()
