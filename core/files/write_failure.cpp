// The next step by the reason.
#include "core/files/write_failure.hpp"

#include <cerrno>
#include <cstring>

namespace dibhr {

std::string step_after_failed_writing(int error) {
    switch (error) {
        case EACCES:
        case EPERM:
        case EROFS:
            return "choose a folder that you may write to";
        case ENOENT:
            return "make the folder, or choose another";
        case ENOTDIR:
            return "a part of that path is a file: choose another folder";
        case EISDIR:
            return "that is a folder: name a file in it";
        case ENOSPC:
        case EDQUOT:
        case EFBIG:
            return "make room for it, or choose another place";
        default:
            return "choose another place";
    }
}

std::string write_failure(int error, const std::string& what) {
    return what + " (" + std::strerror(error) + "); " + step_after_failed_writing(error);
}

}  // namespace dibhr
