// make_materials: writes the map of every material as PNG.
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "assets/materials/materials.hpp"
#include "core/error.hpp"

namespace {

void write_map(const std::filesystem::path& file, std::vector<std::uint8_t> levels) {
    using dibhr::materials::kSide;
    if (!cv::imwrite(file.string(), cv::Mat{kSide, kSide, CV_8UC1, levels.data()},
                     {cv::IMWRITE_PNG_COMPRESSION, 9}))
        throw dibhr::InputError("cannot write " + file.string() +
                                ": choose a folder that can be written");
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2 || arguments[1][0] == '-') {
        std::cerr << "usage: make_materials DIR  the map of every material, as NAME.png\n";
        return 2;
    }
    try {
        const std::filesystem::path folder{arguments[1]};
        for (const std::string& name : dibhr::materials::names())
            write_map(folder / (name + ".png"), dibhr::materials::map_of(name));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "make_materials: " << error.what() << '\n';
        return 1;
    }
}
