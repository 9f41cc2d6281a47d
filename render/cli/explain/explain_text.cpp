// The description of a scene as text.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "engine/base/errors.h"
#include "render/cli/explain/explain.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

std::string text_of(const ordered_json& value) {
    return printable(value.get<std::string>(), 120);
}

/// 1234567 as 1,234,567.
std::string grouped(const ordered_json& number) {
    std::string text = fmt::format("{}", number.get<std::uint64_t>());
    for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
    return text;
}

/// "1 mesh", "1,234 meshes".
std::string counted(const ordered_json& number, const char* one, const char* many) {
    return fmt::format("{} {}", grouped(number), number == 1 ? one : many);
}

std::string box_text(const ordered_json& bounds) {
    if (bounds.is_null()) return "nothing visible";
    const auto at = [&](const char* end, int k) { return bounds[end][k].get<double>(); };
    return fmt::format("{:.4g} x {:.4g} x {:.4g} m, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
                       at("max", 0) - at("min", 0), at("max", 1) - at("min", 1), at("max", 2) - at("min", 2),
                       at("min", 0), at("min", 1), at("min", 2), at("max", 0), at("max", 1), at("max", 2));
}

std::string track_text(const ordered_json& track) {
    return fmt::format("{} ({} {} keys, {:.4g} to {:.4g} s, {}{})", text_of(track["property"]),
                       track["keys"].get<std::size_t>(), text_of(track["sampling"]), track["first"].get<double>(),
                       track["last"].get<double>(), text_of(track["interpolation"]),
                       track.contains("constant") ? ", all equal" : "");
}

std::string tracks_text(const ordered_json& tracks) {
    return fmt::format("{}", fmt::join(tracks | std::views::transform(track_text), ", "));
}

/// Levels of the tree that are indented. Lines of deeper objects begin with their depth.
constexpr std::size_t max_indent = 32;

std::string object_text(const ordered_json& object) {
    const std::string path = object["path"];
    const std::size_t depth = object["depth"];
    std::string text(2 * std::min(depth, max_indent) + 2, ' ');
    if (depth > max_indent) text += fmt::format("[depth {}] ", depth);
    text += printable(path.substr(path.rfind('/') + 1), 80);
    std::vector<std::string> parts;
    if (object.contains("triangles")) {
        parts.push_back(fmt::format("{} of {}", counted(object["triangles"], "triangle", "triangles"),
                                    fmt::join(object["materials"] | std::views::transform(text_of), ", ")));
    }
    if (object.contains("subdivision_level"))
        parts.push_back(fmt::format("subdivided, level {}", object["subdivision_level"].get<int>()));
    if (object.contains("deforms")) parts.push_back(fmt::format("deforms by {}", text_of(object["deforms"])));
    if (object.contains("camera")) {
        const ordered_json& camera = object["camera"];
        parts.push_back(
            camera.contains("fov_degrees")
                ? fmt::format("camera, {:.4g} degrees high", camera["fov_degrees"].get<double>())
                : fmt::format("orthographic camera, {:.4g} m high", 2.0 * camera["half_height"].get<double>()));
        if (!camera["animated"].empty()) parts.push_back(fmt::format("animated {}", tracks_text(camera["animated"])));
    }
    if (object.contains("area_light")) parts.push_back("area light");
    if (object.contains("light")) {
        parts.push_back(fmt::format("{} light", text_of(object["light"]["kind"])));
        if (!object["light"]["animated"].empty())
            parts.push_back(fmt::format("animated {}", tracks_text(object["light"]["animated"])));
    }
    if (object.contains("hidden")) parts.push_back("hidden");
    if (object.contains("detached")) parts.push_back("not moved by its parent");
    if (object.contains("from") && object["depth"].get<int>() == 0)
        parts.push_back(fmt::format("from {}", text_of(object["from"])));
    if (object.contains("animated")) parts.push_back(fmt::format("animated {}", tracks_text(object["animated"])));
    if (!parts.empty()) text += fmt::format(": {}", fmt::join(parts, "; "));
    return text + '\n';
}

/// The first objects of the tree, and the moving ones among the rest.
std::string objects_text(const ordered_json& objects, std::size_t max_lines) {
    std::string text = "\nobjects\n";
    for (std::size_t i = 0; i < std::min(max_lines, objects.size()); ++i) text += object_text(objects[i]);
    if (objects.size() <= max_lines) return text;
    text += fmt::format("  ... and {} more (--objects 0 shows all)\n", objects.size() - max_lines);
    std::size_t moving = 0;
    std::string lines;
    for (std::size_t i = max_lines; i < objects.size(); ++i) {
        if (!objects[i].contains("animated") || ++moving > max_lines) continue;
        lines += fmt::format("  {}: {}\n", text_of(objects[i]["path"]), tracks_text(objects[i]["animated"]));
    }
    if (moving > 0) text.append("\nfurther objects that move\n").append(lines);
    if (moving > max_lines) text += fmt::format("  ... and {} more\n", moving - max_lines);
    return text;
}

std::string list_text(const char* title, const ordered_json& items) {
    if (items.empty()) return {};
    std::string text = fmt::format("\n{}\n", title);
    for (const ordered_json& item : items) text += fmt::format("  {}\n", printable(item.get<std::string>(), 400));
    return text;
}

std::string frames_text(const ordered_json& frames) {
    std::string text = fmt::format(
        "frames    {} to {} at {} a second ({:.4g} to {:.4g} s), {}", frames["first"].get<std::int64_t>(),
        frames["last"].get<std::int64_t>(), text_of(frames["per_second"]), frames["first_second"].get<double>(),
        frames["last_second"].get<double>(), frames["from"] == "given" ? "as the scene says" : "the span of its keys");
    if (!frames["cuts"].empty()) text += fmt::format("; camera cuts at {}", frames["cuts"].dump());
    return text + '\n';
}

std::string environment_text(const ordered_json& environment) {
    if (environment.is_null()) return {};
    std::string text = "light     environment";
    const auto color = [&](const char* key) {
        const ordered_json& c = environment[key];
        return fmt::format("({:.4g}, {:.4g}, {:.4g})", c[0].get<double>(), c[1].get<double>(), c[2].get<double>());
    };
    if (environment.contains("image")) {
        const ordered_json& size = environment["size"];
        text += fmt::format(" picture {}, {} x {}, {}, times {}", text_of(environment["image"]), size[0].get<int>(),
                            size[1].get<int>(), environment["rotates"] ? "rotating" : "not rotating", color("factor"));
    } else {
        text += fmt::format(" of radiance {}", color("radiance"));
    }
    if (!environment["animated"].empty()) text += "; animated " + tracks_text(environment["animated"]);
    return text + '\n';
}

/// "2 lights (1 of area)".
std::string lights_text(const ordered_json& counts) {
    std::string text = counted(counts["lights"], "light", "lights");
    if (counts["area_lights"] != 0) text += fmt::format(" ({} of area)", grouped(counts["area_lights"]));
    return text;
}

std::string counts_text(const ordered_json& counts) {
    return fmt::format(
        "holds     {} ({} animated, {} hidden), {} in {}; {} in {}\n          {}, {}, {}, {}, {}, {}\n",
        counted(counts["objects"], "object", "objects"), grouped(counts["animated_objects"]),
        grouped(counts["hidden_objects"]), counted(counts["triangles"], "triangle", "triangles"),
        counted(counts["meshes"], "mesh", "meshes"), counted(counts["instanced_triangles"], "triangle", "triangles"),
        counted(counts["instances"], "instance", "instances"),
        counted(counts["deforming_meshes"], "deforming mesh", "deforming meshes"),
        counted(counts["subdivision_cages"], "subdivision cage", "subdivision cages"),
        counted(counts["materials"], "material", "materials"), counted(counts["images"], "image", "images"),
        lights_text(counts), counted(counts["cameras"], "camera", "cameras"));
}

std::string bound_text(const ordered_json& bound) {
    if (bound.is_null()) return "not known";
    const auto number = [](const ordered_json& value) {
        const double known = value.get<double>();
        return std::isfinite(known) ? fmt::format("{:.2g}", known) : std::string("not known");
    };
    if (bound["luminance"] == 0.0) return "0";
    return fmt::format("{} cd/m2, {} thresholds", number(bound["luminance"]), number(bound["thresholds"]));
}

/// Those that something has set. The error that `aleph render` asks for by itself is one.
std::string settings_text(const ordered_json& settings) {
    std::string text;
    for (const ordered_json& setting : settings) {
        const bool is_asked = setting["key"] == "error" && setting["value"] != 0.0;
        if (setting["from"] == "default" && !is_asked) continue;
        const ordered_json& value = setting["value"];
        text += fmt::format("  {:<18} {:<11} {}\n", text_of(setting["key"]),
                            value.is_number()   ? fmt::format("{:g}", value.get<double>())
                            : value.is_string() ? text_of(value)
                                                : value.dump(),
                            text_of(setting["from"]));
    }
    return text.empty() ? text : "\nsettings of `aleph render`, and where they come from\n" + text;
}

}  // namespace

std::string plan_text(const ordered_json& plan, const ordered_json& frames) {
    if (plan.empty()) return {};
    std::string text = fmt::format("\neffects plan, of frame{} {}\n", frames.size() == 1 ? "" : "s", frames.dump());
    text += fmt::format("  {:<18} {:<11} {:<9} {} [at most]\n", "effect", "frames", "", "reason");
    std::string before;
    for (const ordered_json& item : plan) {
        const std::string effect = item["effect"], reason = item["reason"], decision = item["decision"];
        const int first = item["frames"][0], last = item["frames"][1];
        text +=
            fmt::format("  {:<18} {:<11} {:<9} {}", effect == before ? "" : effect,
                        first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last), decision, reason);
        if (decision != "simulate") text += fmt::format(" [{}]", bound_text(item["bound"]));
        text += '\n';
        before = effect;
    }
    return text;
}

std::string explain_text(const ordered_json& explained, std::size_t max_objects) {
    std::string text = fmt::format("{}\n", printable(explained["file"].get<std::string>(), 300));
    text += "units     metres, seconds, degrees; y up\n";
    text += frames_text(explained["frames"]);
    if (explained["camera"].is_string()) {
        text += fmt::format("camera    {}", text_of(explained["camera"]));
        for (const ordered_json& change : explained.value("camera_changes", ordered_json::array())) {
            text += fmt::format("; from frame {} {}", change["frame"].get<std::int64_t>(), text_of(change["camera"]));
        }
        text += '\n';
        const ordered_json& exposure = explained["exposure"];
        text += fmt::format("exposure  {:.6g}, {}\n", exposure["factor"].get<double>(),
                            exposure["from"] == "given"      ? "as the scene says"
                            : exposure["from"] == "no frame" ? "since its frames show no direct light"
                                                             : "from its first frame that is not black");
    }
    text += environment_text(explained["environment"]);
    text += counts_text(explained["counts"]);
    text += fmt::format("bounds    {}\n", box_text(explained["bounds"]["range"]));

    text += objects_text(explained["objects"], max_objects == 0 ? explained["objects"].size() : max_objects);
    std::string materials;
    for (const ordered_json& material : explained["materials"]) {
        if (!material.contains("animated")) continue;
        materials += fmt::format("  {}: {}\n", text_of(material["name"]), tracks_text(material["animated"]));
    }
    if (!materials.empty()) text.append("\nanimated materials\n").append(materials);
    if (!explained["time_samplings"].empty()) {
        text += "\ntime samplings\n";
        for (const ordered_json& sampling : explained["time_samplings"]) {
            text +=
                fmt::format("  {} keys, {:.6g} to {:.6g} s, {}: {}\n", sampling["keys"].get<std::size_t>(),
                            sampling["first"].get<double>(), sampling["last"].get<double>(),
                            text_of(sampling["sampling"]), counted(sampling["properties"], "property", "properties"));
        }
    }
    if (explained.contains("settings")) text += settings_text(explained["settings"]);
    if (explained.contains("plan")) text += plan_text(explained["plan"], explained["plan_frames"]);
    text += list_text("nothing uses", explained["unused"]);
    text += list_text("warnings", explained["warnings"]);
    return text;
}

}  // namespace aleph
