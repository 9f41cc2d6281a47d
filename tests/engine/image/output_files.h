#pragma once
// A picture to write, and what a write leaves: the file, the folder, the error.

#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/sampling.h"
#include "engine/image/image_file.h"

namespace aleph {

/// How many files and folders are in it.
inline std::size_t entries_in(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

/// Noise that does not compress.
inline ChannelImage noise_image(int width, int height, const std::vector<std::string>& names = {"R", "G", "B"}) {
    ChannelImage image;
    RandomStream random({.seed = 1});
    for (const std::string& name : names) {
        image.channels.push_back({name, Image<float>(width, height)});
        for (float& v : image.channels.back().values.pixels) v = random.next();
    }
    return image;
}

inline std::string output_error(const std::function<void()>& write) {
    try {
        write();
    } catch (const OutputError& e) {
        return e.what();
    }
    return "(no error)";
}

}  // namespace aleph
