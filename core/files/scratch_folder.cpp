// A temporary folder.
#include "core/files/scratch_folder.hpp"

#include <cstdlib>
#include <system_error>

#include "core/error.hpp"

namespace dibhr {

ScratchFolder::ScratchFolder(const std::string& purpose) {
    std::string pattern = (std::filesystem::temp_directory_path() / "dibhr-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
        throw InputError(pattern + ": cannot be made, and " + purpose +
                         ": set TMPDIR to a folder with room");
    path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace dibhr
