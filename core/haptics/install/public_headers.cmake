# Copies headers of the source tree as programs outside include them:
#   cmake -Dnames=a.hpp,b.hpp -Dto=FOLDER -P public_headers.cmake, in the headers' folder
string(REPLACE "," ";" names ${names})
foreach(name ${names})
  file(READ ${name} text)
  string(REGEX REPLACE "#include \"core/haptics/([a-z_]+[.]h(pp)?)\"" "#include <dibhr/\\1>" text "${text}")
  if(text MATCHES "#include \"")
    message(FATAL_ERROR "${name} includes a header that is not installed with it")
  endif()
  file(WRITE ${to}/${name} "${text}")
endforeach()
