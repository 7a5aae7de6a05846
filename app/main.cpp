// The program `dibhr`.
#include "app/commands/program.hpp"

int main(int argc, char** argv) {
    return dibhr::run_program(argc, argv);
}
