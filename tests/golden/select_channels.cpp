// select_channels IN.exr OUT.exr NAME...: keeps the named channels and layers, so that golden images stay small. A name
// that is missing is an error.

#include <exception>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"

int main(int argc, char** argv) {
    if (argc < 4) {
        std::cerr << "usage: select_channels IN.exr OUT.exr NAME...\n";
        return 2;
    }
    try {
        const aleph::ChannelImage image = aleph::read_image(argv[1]);
        aleph::ChannelImage kept{{}, image.metadata};
        std::vector<bool> found(static_cast<std::size_t>(argc), false);
        for (const aleph::Channel& channel : image.channels) {
            for (int i = 3; i < argc; ++i) {
                const std::string name = argv[i];
                if (channel.name != name && !channel.name.starts_with(name + ".")) continue;
                kept.channels.push_back(channel);
                found[static_cast<std::size_t>(i)] = true;
                break;
            }
        }
        for (int i = 3; i < argc; ++i) {
            if (found[static_cast<std::size_t>(i)]) continue;
            throw aleph::InputError(argv[1], "channel '" + aleph::printable(argv[i]) + "'", "is missing");
        }
        aleph::write_exr(argv[2], kept);
    } catch (const std::exception& e) {
        std::cerr << "select_channels: " << e.what() << "\n";
        return 1;
    }
}
