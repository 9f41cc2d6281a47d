#include "render/study/threshold_noise.h"

#include "engine/base/errors.h"
#include "engine/base/sampling.h"
#include "render/compare/compare_luminance.h"

namespace aleph {

std::optional<ThresholdNoise> find_noise(const SettingMap& settings, const std::string& variant) {
    for (const char* key : {noise_key, zero_mean_noise_key}) {
        const auto found = settings.find(key);
        if (found == settings.end()) continue;
        if (settings.size() > 1)
            throw InputError("", variant, "noise is added to the reference: no other setting stands beside it");
        const double* factor = std::get_if<double>(&found->second);
        if (factor == nullptr || !(*factor >= 0.0 && *factor <= 1000.0))
            throw InputError("", variant, "expected a number from 0 to 1000, times the threshold");
        return ThresholdNoise{*factor, key == zero_mean_noise_key};
    }
    return std::nullopt;
}

ChannelImage add_threshold_noise(const ChannelImage& reference, const Image<float>& threshold,
                                 const ThresholdNoise& noise, std::uint32_t seed, std::int64_t frame) {
    ChannelImage noisy = reference;
    std::erase_if(noisy.channels, [](const Channel& channel) {
        return channel.name != "R" && channel.name != "G" && channel.name != "B";
    });
    const double scale = noise.factor / display_white_of(reference, reference);
    for (std::size_t i = 0; i < threshold.size(); ++i) {
        const RandomKey key{seed, static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(i), 0x6e6f6973u};
        const double unit = static_cast<double>(RandomStream(key).next());
        const double added =
            scale * static_cast<double>(threshold.pixels[i]) * (noise.zero_mean ? 2.0 * unit - 1.0 : unit);
        for (Channel& channel : noisy.channels) channel.values.pixels[i] += static_cast<float>(added);
    }
    return noisy;
}

}  // namespace aleph
