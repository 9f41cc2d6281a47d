// The limits in images.txt: a leak of light in one percent of a golden image's pixels must fail, though --share allows
// for as many.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>

#include "engine/image/image_file.h"
#include "render/compare_luminance.h"
#include "tests/support/paths.h"
#include "tests/support/run_compare.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

struct Golden {
    std::string name;
    std::vector<std::string> limits;
    ChannelImage reference;
};

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// The images whose reference exists.
std::vector<Golden> load_golden() {
    const fs::path folder = source_folder() / "tests/golden";
    std::ifstream file(folder / "images.txt");
    std::vector<Golden> images;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::vector<std::string> columns;
        std::istringstream stream(line);
        for (std::string column; std::getline(stream, column, '|');) columns.push_back(column);
        EXPECT_EQ(columns.size(), 5u) << line;
        const std::string name = words_of(columns.at(0)).at(0);
        if (!fs::exists(folder / (name + ".exr"))) continue;
        images.push_back({name, words_of(columns.at(4)), read_image(folder / (name + ".exr"))});
    }
    return images;
}

/// Compares a changed picture with the reference.
int compare_with(const ChannelImage& changed, const ChannelImage& reference, const std::vector<std::string>& limits) {
    const ScratchFolder folder;
    write_exr(folder / "changed.exr", changed);
    write_exr(folder / "reference.exr", reference);
    std::vector<std::string> arguments{folder / "changed.exr", folder / "reference.exr"};
    arguments.insert(arguments.end(), limits.begin(), limits.end());
    const CompareOutcome outcome = run_compare(arguments);
    EXPECT_LE(outcome.code, 1) << outcome.errors;
    return outcome.code;
}

/// Adds `light` (white is 1) to the darkest pixels.
ChannelImage with_leak(const ChannelImage& picture, std::size_t count, float light) {
    const Image<Rgb> colour = linear_colour(picture);
    std::vector<std::size_t> order(colour.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return luminance(colour.pixels[a]) < luminance(colour.pixels[b]);
    });
    ChannelImage leaky = picture;
    for (Channel& channel : leaky.channels) {
        for (std::size_t k = 0; k < count; ++k) channel.values.pixels[order[k]] += light;
    }
    return leaky;
}

TEST(Golden, LeakInOnePercentOfAFrameFails) {
    std::size_t frames = 0;
    for (const Golden& golden : load_golden()) {
        if (linear_colour(golden.reference).empty()) continue;
        ++frames;
        EXPECT_EQ(compare_with(golden.reference, golden.reference, golden.limits), 0) << golden.name;
        const std::size_t count = golden.reference.channels[0].values.size() / 100;
        const ChannelImage leaky = with_leak(golden.reference, count, 0.02f);
        EXPECT_EQ(compare_with(leaky, golden.reference, {"--relative", "1e-4", "--share", "1"}), 0) << golden.name;
        EXPECT_EQ(compare_with(leaky, golden.reference, golden.limits), 1) << golden.name;
        // The share alone does not find a few pixels.
        const ChannelImage spots = with_leak(golden.reference, 3, 0.1f);
        EXPECT_EQ(compare_with(spots, golden.reference, golden.limits), 1) << golden.name;
    }
    EXPECT_GE(frames, 1u);
}

TEST(Golden, WrongMapsInAThousandthOfThePixelsFail) {
    std::size_t maps = 0;
    for (const Golden& golden : load_golden()) {
        if (!linear_colour(golden.reference).empty()) continue;
        ++maps;
        for (std::size_t c = 0; c < golden.reference.channels.size(); ++c) {
            ChannelImage wrong = golden.reference;
            Image<float>& values = wrong.channels[c].values;
            for (std::size_t i = 0; i < values.size() / 1000; ++i) values.pixels[i] += 1.0f;
            EXPECT_EQ(compare_with(wrong, golden.reference, golden.limits), 1)
                << golden.name << " " << wrong.channels[c].name;
        }
    }
    EXPECT_EQ(maps, 2u);
}

}  // namespace
}  // namespace aleph
