// A module that holds nothing but the names of its libraries: see forward.hpp.
