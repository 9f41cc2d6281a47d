#include "render/images/picture_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "engine/json/close_names.h"
#include "render/compare/compare_luminance.h"
#include "render/compare/visible_difference.h"

namespace aleph {

namespace {

constexpr float far_depth = 1e10f;
constexpr const char* no_layer = "none";

std::string layer_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

/// "ViewLayer.Combined" is called "Combined".
std::string last_name(const std::string& layer) {
    const std::size_t dot = layer.rfind('.');
    return dot == std::string::npos ? layer : layer.substr(dot + 1);
}

class Layers {
  public:
    Layers(const ChannelImage& file, std::string name) : file_(file), name_(std::move(name)) {
        for (const Channel& channel : file.channels) {
            const std::string layer = layer_of(channel.name);
            if (std::ranges::find(all_, layer) == all_.end()) all_.push_back(layer);
        }
    }

    const Image<float>* find(const std::string& layer, const char* channel) const {
        return file_.find(layer.empty() ? channel : layer + '.' + channel);
    }

    template <std::size_t Count>
    bool has(const std::string& layer, const std::array<const char*, Count>& channels) const {
        return std::ranges::all_of(channels, [&](const char* c) { return find(layer, c) != nullptr; });
    }

    /// The layer that is named, if it exists.
    void require(const std::string& layer, const char* option) const {
        if (std::ranges::find(all_, layer) != all_.end()) return;
        std::vector<std::string> known;
        std::ranges::copy_if(all_, std::back_inserter(known), [](const std::string& name) { return !name.empty(); });
        throw InputError(name_, option,
                         fmt::format("there is no layer \"{}\"{}", printable(layer),
                                     known.empty() ? "; the file has no layers" : suggestion(layer, known)));
    }

    /// Those layers that a rule accepts: the only one, or the only one called `usual`.
    template <class Accept>
    std::optional<std::string> choose(const char* what, const char* usual, const char* option,
                                      const Accept& accept) const {
        std::vector<std::string> found, called;
        for (const std::string& layer : all_) {
            if (!accept(layer)) continue;
            found.push_back(layer);
            if (last_name(layer) == usual) called.push_back(layer);
        }
        if (found.empty()) return std::nullopt;
        if (found.size() == 1) return found.front();
        if (called.size() == 1) return called.front();
        std::string list;
        for (const std::string& layer : found) list += (list.empty() ? "" : ", ") + printable(layer);
        throw InputError(name_, "", fmt::format("several layers hold {}: {}; choose one with {}", what, list, option));
    }

    const std::string& name() const { return name_; }

  private:
    const ChannelImage& file_;
    std::string name_;
    std::vector<std::string> all_;
};

constexpr std::array color_channels{"R", "G", "B"};
constexpr std::array uv_channels{"u", "v"};
constexpr std::array vector_channels{"X", "Y", "Z", "W"};
constexpr std::array depth_channel{"Z"};

Image<Rgb> read_color(const Layers& layers, const std::string& wanted, bool encoded) {
    std::optional<std::string> layer = wanted;
    if (!wanted.empty()) layers.require(wanted, "--layer");
    const bool at_root = layers.has("", color_channels) || layers.find("", "Y") != nullptr;
    if (wanted.empty() && !at_root) {
        layer = layers.choose("colour", "Combined", "--layer",
                              [&](const std::string& name) { return layers.has(name, color_channels); });
    }
    const bool grey = layer && !layers.has(*layer, color_channels);
    if (!layer || (grey && layers.find(*layer, "Y") == nullptr)) {
        throw InputError(layers.name(), wanted.empty() ? "" : "--layer", "a frame needs channels R, G and B, or Y");
    }
    Image<Rgb> color;
    for (int c = 0; c < 3; ++c) {
        const Image<float>& channel = *layers.find(*layer, grey ? "Y" : color_channels[c]);
        if (c == 0) color = Image<Rgb>(channel.width, channel.height);
        for (std::size_t i = 0; i < color.size(); ++i) color.pixels[i][c] = channel.pixels[i];
    }
    if (!encoded) return color;
    const Image<float>* const alpha = layers.find(*layer, "A");
    for (std::size_t i = 0; i < color.size(); ++i) {
        Rgb& pixel = color.pixels[i];
        for (int c = 0; c < 3; ++c) pixel[c] = srgb_to_linear(pixel[c]);
        if (alpha != nullptr) pixel *= alpha->pixels[i];
    }
    return color;
}

std::optional<std::string> choose_motion(const Layers& layers, const std::string& wanted) {
    if (wanted == no_layer) return std::nullopt;
    const auto holds = [&](const std::string& name) {
        return layers.has(name, uv_channels) || layers.has(name, vector_channels);
    };
    if (!wanted.empty()) {
        layers.require(wanted, "--motion-layer");
        if (holds(wanted)) return wanted;
        throw InputError(layers.name(), "--motion-layer",
                         "motion needs channels u and v, or X, Y, Z and W, of this layer");
    }
    if (layers.has("forward", uv_channels)) return "forward";
    return layers.choose("motion", "Vector", "--motion-layer", [&](const std::string& name) {
        return last_name(name) == "Vector" && layers.has(name, vector_channels);
    });
}

Image<float> read_depth(const Layers& layers, const std::string& wanted) {
    if (wanted == no_layer) return {};
    std::optional<std::string> layer = wanted;
    if (!wanted.empty()) {
        layers.require(wanted, "--depth-layer");
        if (!layers.has(wanted, depth_channel)) {
            throw InputError(layers.name(), "--depth-layer", "depth needs a channel Z of this layer");
        }
    } else if (!layers.has("", depth_channel)) {
        layer = layers.choose("depth", "Depth", "--depth-layer", [&](const std::string& name) {
            return last_name(name) == "Depth" && layers.has(name, depth_channel);
        });
    }
    return layer ? *layers.find(*layer, "Z") : Image<float>();
}

/// The channels of a motion, and what takes them to x right, y down.
struct MotionChannels {
    const Image<float>&u, &v;
    glm::dvec2 sign;
    const Image<float>* codes = nullptr;   ///< null: none
    const Image<float>* speeds = nullptr;  ///< null: the path is as long as the displacement
    double pixels_by_speed = 0.0;          ///< takes speeds to the path's length
};

MotionField read_motion(const MotionChannels& channels, const Image<float>& depth) {
    const auto& [u, v, sign, codes, speeds, pixels_by_speed] = channels;
    const double longest = std::hypot(u.width, u.height);
    MotionField motion = make_motion_field(u.width, u.height, MotionValidity::valid);
    for (int y = 0; y < u.height; ++y) {
        for (int x = 0; x < u.width; ++x) {
            glm::dvec2 way = sign * glm::dvec2(u(x, y), v(x, y));
            MotionValidity& validity = motion.validity(x, y);
            const bool finite = std::isfinite(way.x) && std::isfinite(way.y);
            if (!finite) way = glm::dvec2(0.0);
            const double length = glm::length(way);
            const bool far = !depth.empty() && !(depth(x, y) < far_depth);
            if (!finite) {
                validity = MotionValidity::no_counterpart;
            } else if (codes != nullptr && std::isfinite((*codes)(x, y))) {
                validity = static_cast<MotionValidity>(std::lround(std::clamp((*codes)(x, y), -4.0f, 1.0f)));
            } else if (far && length == 0.0) {
                validity = MotionValidity::background;
            } else if (const glm::dvec2 place = glm::dvec2(x + 0.5, y + 0.5) + way;
                       !(place.x >= 0.0 && place.y >= 0.0 && place.x <= u.width && place.y <= u.height)) {
                validity = MotionValidity::leaves_screen;
            }
            if (length > longest) way *= longest / length;
            motion.displacement(x, y) = way;
            motion.path_length(x, y) = std::min(length, longest);
            if (speeds != nullptr && (*speeds)(x, y) >= 0.0f && std::isfinite((*speeds)(x, y)))
                motion.path_length(x, y) = (*speeds)(x, y) * pixels_by_speed;
        }
    }
    return motion;
}

/// Pixels per frame for each degree per second, by the file's attributes; 0 where they do not tell.
double find_pixels_by_speed(const ChannelImage& file) {
    const std::optional<FrameRate> rate = find_frame_rate(file);
    const std::optional<double> density = find_number(file, "pixelsPerDegree");
    if (!rate || !density) return 0.0;
    const double factor = *density * static_cast<double>(rate->denominator) / static_cast<double>(rate->numerator);
    return factor > 0.0 && std::isfinite(factor) ? factor : 0.0;
}

/// Motion to the next frame, and where the layer has it, to the frame before.
void read_motions(const ChannelImage& file, const Layers& layers, const std::string& layer, PictureFrame& frame) {
    const auto channel = [&](const std::string& of, const char* name) -> const Image<float>& {
        return *layers.find(of, name);
    };
    const glm::dvec2 y_up(1.0, -1.0);
    if (!layers.has(layer, uv_channels)) {
        frame.motion = read_motion({channel(layer, "Z"), channel(layer, "W"), -y_up}, frame.depth);
        frame.backward = read_motion({channel(layer, "X"), channel(layer, "Y"), y_up}, frame.depth);
        return;
    }
    const bool own = layer == "forward";
    MotionChannels forward{channel(layer, "u"), channel(layer, "v"), y_up};
    if (own) {
        forward.codes = layers.find("motion", "valid");
        forward.pixels_by_speed = find_pixels_by_speed(file);
        if (forward.pixels_by_speed > 0.0) forward.speeds = layers.find("velocity", "image");
    }
    frame.motion = read_motion(forward, frame.depth);
    if (!own || !layers.has("backward", uv_channels)) return;
    frame.backward = read_motion(
        {channel("backward", "u"), channel("backward", "v"), y_up, layers.find("backward", "valid")}, frame.depth);
}

}  // namespace

PictureFrame read_picture_frame(const std::filesystem::path& path, const PictureLayers& wanted) {
    const ChannelImage file = read_image(path);
    const Layers layers(file, printable(path.string(), 4096));
    PictureFrame frame;
    frame.color = read_color(layers, wanted.color, file.metadata.contains("encoding"));
    frame.depth = read_depth(layers, wanted.depth);
    if (const std::optional<std::string> motion = choose_motion(layers, wanted.motion))
        read_motions(file, layers, *motion, frame);
    return frame;
}

}  // namespace aleph
