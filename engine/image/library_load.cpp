#include "engine/image/library.h"

#ifdef ALEPH_IMAGES_LINKED

const aleph::ImageLibrary& aleph::image_library() {
    return *aleph_image_library();
}

#else

#include <dlfcn.h>
#include <fmt/format.h>

#include "engine/base/errors.h"
#include "engine/base/files.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "libaleph_images.so";

[[noreturn]] void refuse(const std::string& reason) {
    throw InputError("", "", fmt::format("PNG, JPEG and HDR files need {}: {}", file_name, reason));
}

/// Beside the program or Python module, as it is built, or where CMake installs it.
/// @throws InputError
fs::path find_file() {
    const fs::path folder = fs::canonical(code_file()).parent_path();
    const fs::path installed = (folder / ALEPH_IMAGES_FOLDER).lexically_normal();
    for (const fs::path& place : {folder, installed})
        if (fs::exists(place / file_name)) return place / file_name;
    refuse(fmt::format("it is not in {} or {}; it is built with the program: copy it to one of them, or use EXR files",
                       printable(folder.string(), 400), printable(installed.string(), 400)));
}

const ImageLibrary* load() {
    const fs::path file = find_file();
    void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const function = library != nullptr ? ::dlsym(library, "aleph_image_library") : nullptr;
    if (function == nullptr) {
        const char* const reason = ::dlerror();
        refuse(printable(reason ? reason : "no table", 400));
    }
    return reinterpret_cast<decltype(&aleph_image_library)>(function)();
}

}  // namespace

const ImageLibrary& image_library() {
    static const ImageLibrary* const library = load();
    return *library;
}

}  // namespace aleph

#endif
