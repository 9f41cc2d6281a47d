#include "render/compare/reference_passes.h"

#include <cmath>
#include <limits>
#include <string>

#include "render/compare/compare_luminance.h"

namespace aleph {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr const char *variance_name = "variance.Y", *passes_key = "passes", *exposure_key = "exposureFactor";

}  // namespace

double reference_passes(const ChannelImage& reference) {
    return find_number(reference, passes_key).value_or(0.0);
}

void add_pass(ChannelImage& mean, const ChannelImage& pass) {
    const double count = reference_passes(mean);
    if (count == 0.0) {
        mean = pass;
        const Image<float>& red = pass.channels.front().values;
        mean.channels.push_back({variance_name, Image<float>(red.width, red.height, infinite)});
        for (const char* name : {"R", "G", "B"})
            mean.channels.push_back({std::string("noise.") + name, *pass.find(name)});
        mean.metadata[passes_key] = 1.0;
        return;
    }
    const float sign = std::fmod(count, 2.0) == 0.0 ? 1.0f : -1.0f;
    const Image<Rgb> before = linear_colour(mean), added = linear_colour(pass);
    for (Channel& channel : mean.channels) {
        for (std::size_t i = 0; i < before.size(); ++i) {
            float& value = channel.values.pixels[i];
            if (channel.name.starts_with("noise.")) {  // the passes with alternating signs
                const float signed_pass = sign * pass.find(channel.name.substr(6))->pixels[i];
                value += static_cast<float>((signed_pass - value) / (count + 1.0));
                continue;
            }
            if (channel.name != variance_name) {
                value += static_cast<float>((pass.find(channel.name)->pixels[i] - value) / (count + 1.0));
                continue;
            }
            const double squares = count > 1.0 ? value * count * (count - 1.0) : 0.0;  // Welford 1962
            const double difference = double{luminance(added.pixels[i])} - luminance(before.pixels[i]);
            value = static_cast<float>((squares / count + difference * difference / (count + 1.0)) / (count + 1.0));
        }
    }
    mean.metadata[passes_key] = count + 1.0;
}

ChannelImage with_exposure_of(ChannelImage picture, const ChannelImage& other) {
    const std::optional<double> wanted = find_number(other, exposure_key);
    if (!wanted) return picture;
    const double exposure = *wanted, had = find_number(picture, exposure_key).value_or(exposure);
    if (had == exposure) return picture;
    for (Channel& channel : picture.channels) {
        const double scale = channel.name == "variance.Y" ? exposure / had * exposure / had : exposure / had;
        for (float& value : channel.values.pixels) value = static_cast<float>(value * scale);
    }
    picture.metadata[exposure_key] = exposure;
    return picture;
}

}  // namespace aleph
