// Writes one line on stderr.
#include "app/error_line.hpp"

#include <algorithm>
#include <iostream>
#include <string>

namespace dibhr {

void print_error_line(std::string_view message) {
    std::string line(message);
    while (!line.empty() && line.back() == '\n') line.pop_back();
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::cerr << "dibhr: " << line << '\n';
}

}  // namespace dibhr
