#include "render/study/pages/pages.h"

#include <Imath/half.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "engine/base/errors.h"
#include "render/compare/visible_difference.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

/// Maps by how much a page needs them: of the frame, and of each variant.
struct MapTier {
    std::vector<const char*> of_frame, of_variant;
};

const std::vector<MapTier> map_tiers{
    {{"threshold.Y", "aleph.Y", "velocity.image", "velocity.retinal", "saliency.Y", "forward.u", "forward.v",
      "motion.valid"},
     {"samples.Y", "error.Y", "alpha.acc"}},
    {{"band.0", "band.1", "band.2", "band.3", "band.4", "band.5", "band.6", "elevation.0", "elevation.1", "elevation.2",
      "elevation.3", "elevation.4", "elevation.5", "elevation.6"},
     {"records.Y", "cache.count", "cache.radius"}},
    {{"conspicuity.intensity", "conspicuity.color", "conspicuity.orientation", "conspicuity.motion"},
     {"error.edges", "error.blur", "error.direct", "error.gloss", "error.indirect"}}};

/// Half precision for what is approximate anyway.
LayerType type_of(std::string_view map) {
    return map.starts_with("error.") || map.starts_with("conspicuity.") ? LayerType::f16 : LayerType::f32;
}

std::vector<const Image<float>*> colours(const ChannelImage& image) {
    std::vector<const Image<float>*> channels;
    for (const char* name : {"R", "G", "B"}) {
        const Image<float>* channel = image.find(name);
        if (channel == nullptr) return {};
        channels.push_back(channel);
    }
    return channels;
}

static_assert(std::endian::native == std::endian::little);

std::uint32_t bits_of(float value, LayerType type) {
    if (type == LayerType::f32) return std::bit_cast<std::uint32_t>(value);
    constexpr float largest = 65504.0f;
    return Imath::half(std::clamp(value, -largest, largest)).bits();
}

std::string compress(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    const int code = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
    if (code != Z_OK) throw std::runtime_error("zlib failed");
    out.resize(size);
    return out;
}

class ReportWriter {
  public:
    ReportWriter(Json& json, const StudyResults& results, std::size_t most_bytes)
        : json_(json), results_(results), layers_(most_bytes) {
        for (const JudgingFrame& frame : results.frames) scenes_.insert(frame.scene);
        // Those that nothing beats come first, so that others are left out before them.
        for (std::size_t v = 0; v < results.variants.size(); ++v) order_.push_back(v);
        std::ranges::stable_sort(order_, {}, [&](std::size_t v) { return !results.variants[v].on_front; });
        const double pixels = json["width"].get<double>() * json["height"].get<double>();
        const double pictures = static_cast<double>((results.variants.size() + 1) * results.frames.size());
        constexpr double bytes_of_pixel = 13.0;  // three floats, compressed, as text
        exact_ = pixels * pictures * bytes_of_pixel < 0.6 * static_cast<double>(most_bytes);
    }

    void write() {
        // The page's errors in visible thresholds need it.
        json_["display_white"] = read_viewing(results_.frames.front().maps).viewing.display_white;
        label_frames();
        add_pictures();
        json_["maps"] = report_maps();
        json_["judges"] = Json::array();
        for (const StudyJudge& judge : results_.judges) add_judge(judge);
        for (const MapTier& tier : map_tiers) add_tier(tier);
        json_["walk"] = report_walk(results_);
        json_["layers_left_out"] = layers_.left_out();
    }

    const std::string& elements() const { return layers_.elements(); }

  private:
    /// Frames are numbers where the study has one scene, else names such as "pool 20".
    Json label(const std::string& scene, std::int64_t frame) const {
        return scenes_.size() > 1 ? Json(fmt::format("{} {}", scene, frame)) : Json(frame);
    }

    void label_frames() {
        if (scenes_.size() == 1) json_["scene"] = *scenes_.begin();
        json_["frames"] = Json::array();
        for (const JudgingFrame& frame : results_.frames) json_["frames"].push_back(label(frame.scene, frame.frame));
        for (Json& variant : json_["variants"]) {
            for (Json& frame : variant["frames"]) frame["frame"] = label(frame["scene"], frame["frame"]);
        }
    }

    void add_pictures() {
        json_["pictures"] = Json::array();
        for (const JudgingFrame& frame : results_.frames) {
            Json& entry = json_["pictures"].emplace_back();
            entry["frame"] = label(frame.scene, frame.frame);
            add_picture(entry, "reference", read_image(frame.reference));
        }
        for_each_picture([&](Json& frame, const ChannelImage& picture) { add_picture(frame, "picture", picture); });
    }

    void add_picture(Json& entry, const char* key, const ChannelImage& picture) {
        add(entry, key, colours(picture), exact_ ? LayerType::f32 : LayerType::f16);
        entry["maps"] = Json::object();
    }

    /// Its map of every picture; those that it lacks are left out.
    void add_judge(const StudyJudge& judge) {
        const std::string name = "judge." + judge.name;
        json_["judges"].push_back({{"name", judge.name}, {"map", name}, {"limit", 1.0}});
        json_["maps"].push_back({{"name", name},
                                 {"title", "visible differences by " + judge.name},
                                 {"unit", "just visible differences"},
                                 {"scale", "log"}});
        if (!judge.frames.empty() && order_.size() > 1) {
            throw InputError(judge.folder.string(), "--judge",
                             "files by frame fit a study of one variant; give a folder with files named like the "
                             "pictures of study.json");
        }
        std::size_t found = 0;
        for (const std::size_t v : order_) {
            for (std::size_t i = 0; i < results_.variants[v].frames.size(); ++i) {
                const std::filesystem::path file = find_map(judge, results_.variants[v].frames[i]);
                if (!std::filesystem::exists(file)) continue;
                const ChannelImage image = read_image(file);
                const Image<float>* map = image.find("Y");
                if (map == nullptr) map = &image.channels.at(0).values;
                if (map->width != json_["width"] || map->height != json_["height"])
                    throw InputError(file.string(), "--judge", "is not of the study's size");
                add(json_["variants"][v]["frames"][i]["maps"], name.c_str(), {map}, LayerType::f16);
                ++found;
            }
        }
        if (found == 0) {
            throw InputError(
                judge.folder.string(), "--judge",
                "has no file named like a picture of the study, such as " +
                    std::filesystem::path(results_.variants.at(0).frames.at(0).picture).filename().string());
        }
    }

    /// The file of a picture's map; empty if there is none.
    static std::filesystem::path find_map(const StudyJudge& judge, const FrameResult& frame) {
        if (judge.frames.empty()) return judge.folder / std::filesystem::path(frame.picture).filename();
        const auto found = judge.frames.find(frame.frame);
        return found == judge.frames.end() ? std::filesystem::path() : found->second;
    }

    void add_tier(const MapTier& tier) {
        for (std::size_t i = 0; i < results_.frames.size(); ++i) {
            for (const char* name : tier.of_frame) add_map(json_["pictures"][i], results_.frames[i].maps, name);
        }
        for_each_picture([&](Json& frame, const ChannelImage& picture) {
            for (const char* name : tier.of_variant) add_map(frame, picture, name);
        });
    }

    /// Calls visit(JSON of the frame, its picture) for every frame of every variant.
    template <class Visit>
    void for_each_picture(const Visit& visit) {
        for (const std::size_t v : order_) {
            for (std::size_t i = 0; i < results_.variants[v].frames.size(); ++i)
                visit(json_["variants"][v]["frames"][i], read_image(results_.variants[v].frames[i].picture));
        }
    }

    void add_map(Json& entry, const ChannelImage& image, const char* name) {
        if (const Image<float>* map = image.find(name)) add(entry["maps"], name, {map}, type_of(name));
    }

    void add(Json& entry, const char* key, const std::vector<const Image<float>*>& channels, LayerType type) {
        if (channels.empty()) return;
        Json layer = layers_.add(channels, type);
        if (!layer.is_null()) entry[key] = std::move(layer);
    }

    Json& json_;
    const StudyResults& results_;
    ReportLayers layers_;
    std::set<std::string> scenes_;
    std::vector<std::size_t> order_;  ///< of the variants
    bool exact_ = false;              ///< pictures as floats
};

}  // namespace

std::string script_json(const char* id, const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return fmt::format("<script id=\"{}\" type=\"application/json\">{}</script>", id,
                       OIIO::Strutil::replace(text, "<", "\\u003c", true));
}

void insert(std::string& page, std::string_view place, const std::string& text) {
    const std::size_t at = page.find(place);
    ALEPH_CHECK(at != std::string::npos, std::string(place));
    page.replace(at, place.size(), text);
}

std::string encode_layer(const std::vector<const Image<float>*>& channels, LayerType type) {
    const std::size_t width = type == LayerType::f16 ? 2 : 4, count = channels.front()->size() * channels.size();
    std::string bytes(width * count, '\0');
    std::size_t at = 0;
    for (const Image<float>* channel : channels) {
        for (const float value : channel->pixels) {
            const std::uint32_t bits = bits_of(value, type);
            for (std::size_t b = 0; b < width; ++b) bytes[b * count + at] = static_cast<char>(bits >> (8 * b));
            ++at;
        }
    }
    return OIIO::Strutil::base64_encode(compress(bytes));
}

nlohmann::ordered_json ReportLayers::add(const std::vector<const Image<float>*>& channels, LayerType type) {
    const std::string text = encode_layer(channels, type);
    if (text.size() > left_) {
        ++left_out_;
        return nullptr;
    }
    left_ -= text.size();
    const std::string name = fmt::format("layer-{}", count_++);
    elements_ += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", name, text);
    return {{"element", name},
            {"width", channels.front()->width},
            {"height", channels.front()->height},
            {"channels", channels.size()},
            {"type", type == LayerType::f16 ? "f16" : "f32"}};
}

std::string make_report(std::string_view page, Json json, const StudyResults& results, std::size_t most_bytes) {
    const std::size_t page_bytes = page.size() + script_json("study", json).size();
    ReportWriter writer(json, results, most_bytes > page_bytes ? most_bytes - page_bytes : 0);
    writer.write();
    std::string text(page);
    insert(text, "<!-- STUDY LAYERS -->", writer.elements());
    insert(text, "<!-- STUDY DATA -->", script_json("study", json));
    return text;
}

}  // namespace aleph
