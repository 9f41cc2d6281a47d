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

/// Beside the program or Python module, as it is built, or where CMake installs it.
fs::path find_file() {
    const fs::path folder = fs::canonical(code_file()).parent_path();
    const fs::path beside = folder / file_name;
    return fs::exists(beside) ? beside : folder / ALEPH_IMAGES_FOLDER / file_name;
}

const ImageLibrary* load() {
    const fs::path file = find_file();
    void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const function = library != nullptr ? ::dlsym(library, "aleph_image_library") : nullptr;
    if (function == nullptr) {
        const char* const reason = ::dlerror();
        throw InputError("", "",
                         fmt::format("PNG, JPEG and HDR files need {}: {}", file_name,
                                     printable(reason ? reason : "no table", 400)));
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
