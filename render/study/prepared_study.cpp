#include "render/study/prepared_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "render/compare/compare_luminance.h"
#include "render/settings/frame_list.h"
#include "render/study/effects_ledger.h"
#include "render/study/reference_picture.h"
#include "render/study/search_study.h"

namespace aleph {

namespace {

PreparedStudyScene prepare_scene(const StudyScene& given) {
    PreparedStudyScene scene;
    scene.name = name_scene(given.file);
    scene.scene = load_scene(given.file.string());
    if (given.frames.empty()) {
        const FrameRange range = frame_range(scene.scene);
        scene.frames = {static_cast<int>(range.first + (range.last - range.first) / 2)};
    } else {
        scene.frames = parse_frame_list(given.frames);
    }
    return scene;
}

bool has_consecutive_frames(const PreparedStudyScene& scene) {
    return std::ranges::adjacent_find(scene.frames, [](int a, int b) { return b == a + 1; }) != scene.frames.end();
}

void refuse_seed(const SettingMap& settings, const std::string& place) {
    if (settings.contains("seed")) throw InputError("", place, "the seeds of a study are its list `seeds`");
}

/// All pictures are compared pixel by pixel.
void refuse(const SettingMap& settings, const std::string& place) {
    if (settings.contains("size"))
        throw InputError("", place, "pictures of a study have one size: `size` of the study");
    refuse_seed(settings, place);
}

/// Another program's pictures are of one scene, and there is one for each of its frames, of the study's size.
void check_pictures(const StudyVariant& variant, const PreparedStudy& prepared) {
    if (prepared.scenes.size() != 1)
        throw InputError("", variant.name, "pictures of another program are judged in a study of one scene");
    const PreparedStudyScene& scene = prepared.scenes.front();
    const PictureSettings size = with_settings_of(scene, prepared.study, {}).settings.picture;
    for (const int frame : scene.frames) {
        const auto found = variant.pictures.find(frame);
        if (found == variant.pictures.end())
            throw InputError("", variant.name, fmt::format("it has no picture of frame {}", frame));
        const Image<Rgb> picture = linear_colour(read_image(found->second));
        if (picture.empty()) throw InputError(found->second.string(), variant.name, "it has no channels R, G and B");
        if (picture.width != size.width || picture.height != size.height)
            throw InputError(found->second.string(), variant.name,
                             fmt::format("it has {}x{} pixels, the study {}x{}", picture.width, picture.height,
                                         size.width, size.height));
    }
}

void check(const PreparedStudy& prepared) {
    refuse_seed(prepared.study.settings, "settings");
    refuse(prepared.study.reference.settings, "reference");
    for (const StudyVariant& variant : prepared.variants) {
        if (!variant.pictures.empty()) check_pictures(variant, prepared);
    }
    for (const PreparedStudyScene& scene : prepared.scenes) {
        for (const StudyVariant& variant : prepared.variants) {
            refuse(variant.settings, variant.name);
            if (find_noise(variant.settings, variant.name)) continue;
            with_settings_of(scene, prepared.study, variant.settings);
        }
        for (const StudyViewer& viewer : prepared.study.viewers) {
            refuse(viewer.settings, viewer.name);
            with_settings_of(scene, prepared.study, viewer.settings);
            if (std::ranges::count(prepared.study.viewers, viewer.name, &StudyViewer::name) > 1)
                throw InputError("", viewer.name, "two viewers of the study have this name");
        }
        with_settings_of(scene, prepared.study, prepared.study.reference.settings);
    }
    for (const StudyVariant& candidate : prepared.candidates) {
        with_settings_of(prepared.scenes.front(), prepared.study, candidate.settings);
        if (std::ranges::find(prepared.variants, candidate.name, &StudyVariant::name) != prepared.variants.end())
            throw InputError("", candidate.name, "a variant of the study has the name of a candidate of its search");
    }
}

}  // namespace

std::string name_scene(const std::filesystem::path& file) {
    const std::filesystem::path path = std::filesystem::absolute(file);
    return path.stem() == "scene" ? path.parent_path().filename().string() : path.stem().string();
}

PreparedStudy prepare_study(Study study) {
    PreparedStudy prepared;
    for (const StudyScene& scene : study.scenes) {
        prepared.scenes.push_back(prepare_scene(scene));
        const std::string& name = prepared.scenes.back().name;
        if (std::ranges::count(prepared.scenes, name, &PreparedStudyScene::name) > 1)
            throw InputError(scene.file.string(), "scenes", fmt::format("two scenes are called {}", printable(name)));
    }
    if (study.effects) {
        for (StudyVariant& variant : list_ledger_variants(prepared.scenes, study))
            study.variants.push_back(std::move(variant));
    }
    prepared.variants = list_variants(study);
    if (study.search) prepared.candidates = list_candidates(study);
    prepared.metrics = list_metrics(study);
    if (std::ranges::none_of(prepared.scenes, has_consecutive_frames))
        std::erase_if(prepared.metrics, [](const Metric& metric) {
            return metric.name == "seed_flicker" || metric.name == "share_flicker" || metric.name == "share_lasting";
        });
    prepared.study = std::move(study);
    check(prepared);
    return prepared;
}

void check_settings(SettingMap settings, const std::string& source) {
    Scene scene;
    RenderSettings render;
    set_scene_numbers(scene, settings, source);
    apply_settings(render, settings, source);
}

SceneWithSettings with_settings_of(const PreparedStudyScene& scene, const Study& study, const SettingMap& more) {
    SceneWithSettings out{scene.scene, {}};
    apply_settings(out.settings, scene.scene.source.settings, scene.scene.source.file);
    SettingMap settings = more;
    settings.insert(study.settings.begin(), study.settings.end());
    set_scene_numbers(out.scene, settings, study.file);
    apply_settings(out.settings, settings, study.file);
    return out;
}

}  // namespace aleph
