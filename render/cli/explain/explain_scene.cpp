// The description of a whole scene.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/base/errors.h"
#include "engine/scene_file/fields.h"
#include "render/cli/explain/explain.h"
#include "render/frame/sequence.h"
#include "render/frame/shot.h"
#include "render/plan/effect_table.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

/// Number of frames whose bounds are joined: every vertex of every frame would take longer than all the rest.
constexpr std::int64_t max_bounds_frames = 33;

ordered_json describe_frames(const Scene& scene) {
    const FrameRange range = frame_range(scene);
    const FrameRate& rate = scene.film.frame_rate;
    return {{"per_second", rate.denominator == 1 ? fmt::format("{}", rate.numerator)
                                                 : fmt::format("{}/{}", rate.numerator, rate.denominator)},
            {"first", range.first},
            {"last", range.last},
            {"from", scene.film.range ? "given" : "keys"},
            {"first_second", rate.seconds_of(range.first)},
            {"last_second", rate.seconds_of(range.last)},
            {"cuts", scene.film.cuts}};
}

/// @param objects  describe_node of all nodes
ordered_json count_elements(const Scene& scene, const ordered_json& objects) {
    std::size_t triangles = 0, instanced = 0, vertices = 0, instances = 0, deforming = 0;
    for (const Mesh& mesh : scene.meshes) {
        triangles += mesh.triangles.size();
        vertices += mesh.positions.size();
        if (how_it_deforms(scene, mesh) != nullptr) ++deforming;
    }
    for (const Node& node : scene.nodes) {
        instances += node.meshes.size();
        for (const int mesh : node.meshes) instanced += scene.meshes[mesh].triangles.size();
    }
    const auto count = [&](const char* key) {
        return std::ranges::count_if(objects, [&](const ordered_json& object) { return object.contains(key); });
    };
    const auto area_lights = count("area_light");
    return {{"objects", scene.nodes.size()},
            {"animated_objects", count("animated")},
            {"hidden_objects", count("hidden")},
            {"meshes", scene.meshes.size()},
            {"deforming_meshes", deforming},
            {"subdivision_cages", scene.cages.size()},
            {"instances", instances},
            {"vertices", vertices},
            {"triangles", triangles},
            {"instanced_triangles", instanced},
            {"materials", scene.materials.size()},
            {"images", scene.images.size()},
            {"lights", count("light") + area_lights},
            {"area_lights", area_lights},
            {"cameras", scene.cameras.size()},
            {"skins", scene.skins.size()},
            {"includes", scene.source.includes.size()}};
}

/// So many frames, evenly spread: the first, the last and some between. Of one, the first.
std::vector<std::int64_t> spread_frames(const FrameRange& range, std::int64_t count) {
    const std::int64_t length = range.last - range.first, steps = std::max<std::int64_t>(count - 1, 1);
    std::vector<std::int64_t> frames;
    for (std::int64_t i = 0; i < count; ++i)
        frames.push_back(range.first + length / steps * i + length % steps * i / steps);
    return frames;
}

ordered_json describe_bounds(const Scene& scene) {
    const FrameRange range = frame_range(scene);
    const auto at_frame = [&](std::int64_t number, Bounds& bounds) {
        const ScenePose posed = pose(scene, scene.film.frame_rate.seconds_of(number));
        for (std::size_t i = 0; i < posed.instances.size(); ++i)
            if (posed.shown[i] != 0) add_instance(bounds, scene, posed, posed.instances[i]);
    };
    Bounds first, all;
    at_frame(range.first, first);
    const std::int64_t most = is_world_animated(scene) ? max_bounds_frames : 1;
    const std::vector<std::int64_t> seen = spread_frames(range, std::min(range.last - range.first + 1, most));
    for (const std::int64_t frame : seen) at_frame(frame, all);
    return {{"first_frame", to_json(first)}, {"range", to_json(all)}, {"range_frames_seen", seen.size()}};
}

/// The time samplings of all keyed properties, each once, with the number of properties that use it.
ordered_json collect_samplings(const ordered_json& objects, const ordered_json& materials,
                               const ordered_json& environment) {
    std::map<std::string, std::pair<ordered_json, int>> found;
    const auto collect = [&](const ordered_json& tracks) {
        for (ordered_json track : tracks) {
            track.erase("property");
            track.erase("interpolation");
            track.erase("constant");
            auto& entry = found[track.dump()];
            entry.first = track;
            ++entry.second;
        }
    };
    for (const ordered_json& object : objects) {
        if (object.contains("animated")) collect(object["animated"]);
        for (const char* part : {"light", "camera"})
            if (object.contains(part)) collect(object[part]["animated"]);
    }
    for (const ordered_json& material : materials)
        if (material.contains("animated")) collect(material["animated"]);
    if (environment.is_object()) collect(environment["animated"]);
    ordered_json out = ordered_json::array();
    for (auto& [text, entry] : found) {
        entry.first["properties"] = entry.second;
        out.push_back(std::move(entry.first));
    }
    return out;
}

struct Use {
    std::set<int> meshes, materials, images, lights, cameras;
};

Use find_use(const Scene& scene) {
    Use use;
    for (const Node& node : scene.nodes) {
        use.meshes.insert(node.meshes.begin(), node.meshes.end());
        use.lights.insert(node.light);
        use.cameras.insert(node.camera);
    }
    use.images.insert(scene.environment.image);
    for (const int mesh : use.meshes) use.materials.insert(scene.meshes[mesh].material);
    for (const int material : use.materials) {
        if (material == no_index) continue;
        for (const auto& field : material_textures)
            use.images.insert(scene.materials[material].textures[field.slot].image);
    }
    return use;
}

ordered_json list_unused(const Scene& scene, const Use& use) {
    ordered_json out = ordered_json::array();
    const auto list = [&](const char* kind, const auto& elements, const std::set<int>& used) {
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (!used.contains(static_cast<int>(i)))
                out.push_back(fmt::format("{} \"{}\"", kind, name_or_number(elements[i].name, kind, i)));
    };
    list("mesh", scene.meshes, use.meshes);
    list("material", scene.materials, use.materials);
    list("image", scene.images, use.images);
    list("light", scene.lights, use.lights);
    list("camera", scene.cameras, use.cameras);
    return out;
}

constexpr std::int64_t few_frames = 8;
constexpr std::size_t most_shots = 12;
constexpr std::int64_t most_views = 100'000;  // of a shot whose camera has cubic keys

/// The plan of one effect over frames that were looked at one after the other.
struct PlannedFrames {
    int first = 0, last = 0;
    PlannedEffect planned;
};

/// The larger bound, with its reason: where one is not known, neither is their maximum.
void join(PlannedFrames& frames, int frame, const PlannedEffect& planned) {
    frames.last = frame;
    std::optional<EffectBound>& bound = frames.planned.bound;
    if (!bound || (planned.bound && planned.bound->thresholds <= bound->thresholds)) return;
    frames.planned = planned;
}

/// The effects plan of these frames, in ascending order: for each effect, frames one after the other with the same
/// decision, with the largest bound and its reason.
ordered_json explain_plan(Sequence& sequence, const std::vector<int>& frames) {
    std::vector<std::vector<PlannedFrames>> shot;
    for (const int frame : frames) {
        const EffectsPlan plan = sequence.plan(frame);
        shot.resize(plan.effects.size());
        for (std::size_t i = 0; i < plan.effects.size(); ++i) {
            const PlannedEffect& planned = plan.effects[i];
            if (!shot[i].empty() && shot[i].back().planned.decision == planned.decision) {
                join(shot[i].back(), frame, planned);
            } else {
                shot[i].push_back({frame, frame, planned});
            }
        }
    }
    ordered_json list = ordered_json::array();
    for (const std::vector<PlannedFrames>& effect : shot) {
        for (const PlannedFrames& part : effect) {
            ordered_json item = to_json(part.planned);
            item["frames"] = {part.first, part.last};
            list.push_back(std::move(item));
        }
    }
    return list;
}

/// Throws for a frame that rendering would refuse because cubic keys overshoot, also where no plan is made.
void check_views(const Scene& scene, const ScenePose& posed, const CameraShot& shot, std::int64_t last) {
    CameraValues values = posed.cameras[shot.camera];
    const Camera& camera = scene.cameras[scene.nodes[values.node].camera];
    if (std::max(camera.fov.interpolation, camera.half_height.interpolation) != Interpolation::cubic) return;
    const FrameRange range{shot.first, last};
    for (const std::int64_t frame : spread_frames(range, std::min(last - shot.first + 1, most_views))) {
        const double seconds = scene.film.frame_rate.seconds_of(frame);
        values.fov = evaluate(camera.fov, seconds);
        values.half_height = evaluate(camera.half_height, seconds);
        make_camera_view(scene, values, 1, 1);
    }
}

/// Camera and exposure, and a warning for what rendering would refuse; a null camera for a scene without one.
void describe_view(ordered_json& out, const Scene& scene, const RenderSettings& settings, const std::string& camera,
                   const std::vector<int>& frames) {
    try {
        Sequence sequence(scene, settings, camera);
        const ScenePose posed = pose(scene, scene.film.frame_rate.seconds_of(frame_range(scene).first));
        const std::vector<CameraShot> shots = list_camera_shots(scene, camera);
        const auto name = [&](const CameraShot& shot) { return scene.nodes[posed.cameras[shot.camera].node].name; };
        out["camera"] = name(shots.front());
        for (std::size_t i = 1; i < shots.size(); ++i) {
            out["camera_changes"].push_back({{"frame", shots[i].first}, {"camera", name(shots[i])}});
        }
        const char* const from = scene.film.exposure ? "given" : sequence.is_dark() ? "no frame" : "first frame";
        out["exposure"] = {{"factor", sequence.exposure()}, {"from", from}};
        for (std::size_t i = 0; i < shots.size(); ++i) {
            find_lens(scene, posed.cameras[shots[i].camera]);
            check_views(scene, posed, shots[i],
                        i + 1 < shots.size() ? shots[i + 1].first - 1 : frame_range(scene).last);
        }
        out["plan_frames"] = frames;
        out["plan"] = explain_plan(sequence, frames);
    } catch (const InputError& error) {
        if (!camera.empty()) throw;
        if (!out.contains("camera")) out["camera"] = nullptr;
        const std::string place = error.place().empty() ? "" : error.place() + ": ";
        out["warnings"].push_back("rendering is refused: " + place + error.reason());
    }
}

/// Nodes with all nodes below them, although those of included files come last in the scene.
std::vector<std::size_t> tree_order(const Scene& scene) {
    std::vector<std::vector<std::size_t>> children(scene.nodes.size());
    std::vector<std::size_t> order, waiting;
    for (std::size_t i = scene.nodes.size(); i-- > 0;) {
        const int parent = scene.nodes[i].parent;
        (parent == no_index ? waiting : children[parent]).push_back(i);
    }
    while (!waiting.empty()) {
        order.push_back(waiting.back());
        waiting.pop_back();
        waiting.insert(waiting.end(), children[order.back()].begin(), children[order.back()].end());
    }
    return order;
}

}  // namespace

std::vector<int> choose_planned_frames(const Scene& scene) {
    const FrameRange range = frame_range(scene);
    const std::int64_t length = range.last - range.first + 1;
    std::set<int> frames;
    for (const std::int64_t frame : spread_frames(range, length <= few_frames ? length : 5))
        frames.insert(static_cast<int>(frame));
    for (const std::int64_t cut : scene.film.cuts) {
        if (frames.size() < most_shots && cut >= range.first && cut <= range.last) frames.insert(static_cast<int>(cut));
    }
    return {frames.begin(), frames.end()};
}

ordered_json explain_scene(const Scene& scene, const RenderSettings& settings, const std::string& camera,
                           const std::vector<int>& frames) {
    ordered_json out = {{"file", scene.source.file}, {"name", scene.source.name}};
    out["units"] = {{"length", "m"}, {"time", "s"}, {"angle", "degrees"}, {"axes", "right-handed, y up"}};
    out["warnings"] = scene.source.warnings;
    out["frames"] = describe_frames(scene);
    describe_view(out, scene, settings, camera, frames);
    out["environment"] = describe_environment(scene);
    const NodePaths paths(scene);
    ordered_json objects = ordered_json::array();
    std::vector<ordered_json> ids(scene.nodes.size(), ordered_json::array());
    const std::vector<Instance> instances = list_instances(scene);
    for (std::size_t id = 0; id < instances.size(); ++id) ids[instances[id].node].push_back(id);
    for (const std::size_t i : tree_order(scene)) {
        objects.push_back(describe_node(scene, i, paths));
        if (!ids[i].empty()) objects.back()["object_ids"] = ids[i];
    }
    out["counts"] = count_elements(scene, objects);
    out["bounds"] = describe_bounds(scene);
    ordered_json materials = describe_materials(scene);
    out["time_samplings"] = collect_samplings(objects, materials, out["environment"]);
    out["objects"] = std::move(objects);
    out["materials"] = std::move(materials);
    out["images"] = describe_images(scene);
    out["includes"] = ordered_json::array();
    for (const Include& include : scene.source.includes) out["includes"].push_back(include.path);
    out["unused"] = list_unused(scene, find_use(scene));
    return out;
}

}  // namespace aleph
