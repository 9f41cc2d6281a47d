#include "render/study/run_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/parallel.h"
#include "engine/scene/scene_hash.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/study/reference_picture.h"

namespace aleph {

namespace {

/// How long a pass of a reference takes, in runs of a frame: for progress alone.
constexpr double frames_per_pass = 4.0;

/// Adds the bands whose sum is the Aleph map of a frame.
void add_bands(const FrameOutput& output, const Scene& scene, const RenderSettings& settings, JudgingFrame& frame) {
    PerceptionSettings perception = settings.perception;
    if (output.perception.saliency.empty()) perception.guide = Guide::full;  // nothing moves, or all is alike
    PerceptionMaps maps = compute_perception(output.estimate, output.velocity, scene.film.viewing,
                                             scene.film.frame_rate, perception, {.bands = true});
    frame.frequencies = band_frequencies(perception.bands, scene.film.viewing.pixels_per_degree);
    for (std::size_t i = 0; i < maps.responses.size(); ++i) {
        frame.maps.channels.push_back({fmt::format("band.{}", i), std::move(maps.responses[i])});
        frame.maps.channels.push_back({fmt::format("elevation.{}", i), std::move(maps.elevations[i])});
    }
}

class StudyRunner {
  public:
    StudyRunner(const PreparedStudy& prepared, const std::filesystem::path& folder, const StudyProgress& progress)
        : prepared_(prepared), study_(prepared.study), store_(folder), progress_(progress) {
        const double runs =
            static_cast<double>(prepared.variants.size() * study_.runs.seeds.size()) * study_.runs.repeats;
        for (const PreparedStudyScene& scene : prepared.scenes)
            work_ += static_cast<double>(scene.frames.size()) * (frames_per_pass * study_.reference.passes + runs);
    }

    StudyResults run() {
        for (const PreparedStudyScene& scene : prepared_.scenes) references_.push_back(prepare_frames(scene));
        std::vector<std::vector<std::vector<MeasuredRun>>> runs(
            prepared_.variants.size(), std::vector<std::vector<MeasuredRun>>(prepared_.scenes.size()));
        for_each_run([&](std::size_t v, std::size_t s, std::uint32_t seed, int repeat) {
            if (!is_made(v) && !runs[v][s].empty()) return;
            MeasuredRun& run =
                runs[v][s].emplace_back(is_made(v) ? find_or_make(v, s, seed, repeat) : take_pictures(v, s));
            if (repeat == 0) measure(s, run, noise_of(v).has_value());
        });
        for (std::size_t v = 0; v < runs.size(); ++v) {
            VariantResult result{prepared_.variants[v].name, prepared_.variants[v].settings, {}, {}, false};
            for (std::size_t s = 0; s < prepared_.scenes.size(); ++s)
                std::ranges::move(summarize_runs(prepared_.scenes[s].name, runs[v][s]),
                                  std::back_inserter(result.frames));
            if (study_.runs.seeds.size() > 1 && is_made(v)) {
                std::vector<std::string> other;
                for (const std::vector<MeasuredRun>& seeds : runs[v])
                    std::ranges::copy(seeds.at(1).pictures, std::back_inserter(other));
                add_seed_metrics(results_.frames, other, result.frames);
            }
            average_frames(result);
            results_.variants.push_back(std::move(result));
        }
        find_front(results_.variants);
        return std::move(results_);
    }

    void make_part(const StudyPart& part) {
        std::size_t item = 0;
        const auto is_ours = [&] { return item++ % part.count == part.index; };
        work_ /= static_cast<double>(part.count);
        for (const PreparedStudyScene& scene : prepared_.scenes) {
            for (const int frame : scene.frames) {
                if (is_ours()) make_reference(scene, frame);
            }
        }
        for_each_run([&](std::size_t v, std::size_t s, std::uint32_t seed, int repeat) {
            if (is_made(v) && is_ours()) find_or_make(v, s, seed, repeat);
        });
    }

    StudyCount count_finished() const {
        StudyCount count;
        for (const PreparedStudyScene& scene : prepared_.scenes) {
            for (const int frame : scene.frames) {
                ++count.references;
                count.finished_references += is_reference_finished(scene, study_, frame, reference_folder()) ? 1 : 0;
            }
        }
        for_each_run([&](std::size_t v, std::size_t s, std::uint32_t seed, int repeat) {
            if (!is_made(v)) return;
            ++count.runs;
            const RunName name = name_run(v, s, seed, repeat, settings_of(v, s, seed));
            count.finished_runs += store_.find(name, prepared_.scenes[s].frames) ? 1 : 0;
        });
        return count;
    }

  private:
    std::filesystem::path reference_folder() const { return store_.folder() / "references"; }

    SceneWithSettings settings_of(std::size_t v, std::size_t s, std::uint32_t seed) const {
        const StudyVariant& variant = prepared_.variants[v];
        SceneWithSettings own = with_settings_of(prepared_.scenes[s], study_, variant.settings);
        if (variant.forbids_more)
            own.settings.effects.forbid.add(with_settings_of(prepared_.scenes[s], study_, {}).settings.effects.forbid);
        own.settings.seed = seed;
        return own;
    }

    RunName name_run(std::size_t v, std::size_t s, std::uint32_t seed, int repeat, const SceneWithSettings& own) const {
        const PreparedStudyScene& scene = prepared_.scenes[s];
        return {scene.name, prepared_.variants[v].name, identity(own, scene.frames), seed, repeat};
    }

    /// Calls visit(variant, scene, seed, repeat) for every run.
    void for_each_run(const auto& visit) const {
        for (int repeat = 0; repeat < study_.runs.repeats; ++repeat) {
            for (const std::uint32_t seed : study_.runs.seeds) {
                for (std::size_t v = 0; v < prepared_.variants.size(); ++v) {
                    for (std::size_t s = 0; s < prepared_.scenes.size(); ++s) visit(v, s, seed, repeat);
                }
            }
        }
    }

    void show(double more, const std::string& what) const {
        if (progress_) progress_(std::min(1.0, (done_ + more) / std::max(1.0, work_)), what);
    }

    /// The maps of every viewer, frame by frame; those of the first are kept.
    void add_viewers(const PreparedStudyScene& scene) {
        const std::size_t first = results_.frames.size();
        for (const StudyViewer& viewer : study_.viewers) {
            SceneWithSettings own = with_settings_of(scene, study_, viewer.settings);
            own.settings.perception.guide = Guide::saliency;
            Sequence sequence(std::move(own.scene), own.settings);
            FrameRequest request;
            request.frame = false;
            request.maps = true;
            for (std::size_t i = 0; i < scene.frames.size(); ++i) {
                show(0.0, fmt::format("thresholds of {} {}", scene.name, scene.frames[i]));
                FrameOutput output = sequence.render(scene.frames[i], request);
                if (results_.frames.size() == first + i) {
                    JudgingFrame& frame = results_.frames.emplace_back();
                    frame.scene = scene.name;
                    frame.frame = scene.frames[i];
                    frame.maps = make_frame_image(output, true, sequence.scene(), own.settings, sequence.exposure());
                    add_bands(output, sequence.scene(), own.settings, frame);
                }
                results_.frames[first + i].thresholds.push_back(output.limits.threshold);
            }
        }
    }

    std::vector<ChannelImage> prepare_frames(const PreparedStudyScene& scene) {
        std::vector<ChannelImage> references;
        const std::size_t first = results_.frames.size();
        add_viewers(scene);
        for (std::size_t i = 0; i < scene.frames.size(); ++i) {
            JudgingFrame& frame = results_.frames[first + i];
            ReferencePicture reference = make_reference(scene, scene.frames[i]);
            frame.reference = std::move(reference.file);
            frame.quality = measure_reference(reference.picture, frame.thresholds.front());
            references.push_back(std::move(reference.picture));
        }
        return references;
    }

    std::span<const JudgingFrame> frames_of(std::size_t s) const {
        std::size_t first = 0;
        for (std::size_t before = 0; before < s; ++before) first += prepared_.scenes[before].frames.size();
        return std::span(results_.frames).subspan(first, prepared_.scenes[s].frames.size());
    }

    ReferencePicture make_reference(const PreparedStudyScene& scene, int frame) {
        ReferencePicture reference =
            find_or_make_reference(scene, study_, frame, reference_folder(), [&](double passes) {
                show(frames_per_pass * passes, fmt::format("reference of {} {}", scene.name, frame));
            });
        done_ += frames_per_pass * study_.reference.passes;
        return reference;
    }

    std::optional<ThresholdNoise> noise_of(std::size_t v) const {
        return find_noise(prepared_.variants[v].settings, prepared_.variants[v].name);
    }

    /// Returns whether a variant is rendered: another program's pictures are there, and noise is added.
    bool is_made(std::size_t v) const { return prepared_.variants[v].pictures.empty() && !noise_of(v); }

    /// The run of pictures that are not rendered: another program's, or the references with noise.
    MeasuredRun take_pictures(std::size_t v, std::size_t s) const {
        const StudyVariant& variant = prepared_.variants[v];
        const PreparedStudyScene& scene = prepared_.scenes[s];
        const std::optional<ThresholdNoise> noise = noise_of(v);
        MeasuredRun run;
        for (std::size_t i = 0; i < scene.frames.size(); ++i) {
            FrameRun& taken = run.frames.emplace_back();
            taken.frame = scene.frames[i];
            taken.plan = "[]";
            taken.timed = false;
            run.pictures.push_back(noise ? write_noisy(variant, s, i, *noise)
                                         : variant.pictures.at(scene.frames[i]).string());
        }
        return run;
    }

    /// Writes the reference of frame i with noise of the first viewer's threshold.
    /// @return the file
    std::string write_noisy(const StudyVariant& variant, std::size_t s, std::size_t i,
                            const ThresholdNoise& noise) const {
        const PreparedStudyScene& scene = prepared_.scenes[s];
        const std::uint32_t seed = study_.runs.seeds.front();
        const RunName name{scene.name, variant.name, name_settings(variant.settings), seed, 0};
        const std::filesystem::path file = store_.picture(name, scene.frames[i]);
        write_exr(file, add_threshold_noise(references_[s][i], frames_of(s)[i].thresholds.front(), noise, seed,
                                            scene.frames[i]));
        return file.string();
    }

    MeasuredRun find_or_make(std::size_t v, std::size_t s, std::uint32_t seed, int repeat) {
        const PreparedStudyScene& scene = prepared_.scenes[s];
        const StudyVariant& variant = prepared_.variants[v];
        const SceneWithSettings own = settings_of(v, s, seed);
        const RunName name = name_run(v, s, seed, repeat, own);
        MeasuredRun run;
        const std::string what = fmt::format("{}: {}", scene.name, variant.name);
        if (auto finished = store_.find(name, scene.frames)) {
            run.frames = std::move(*finished);
            ++results_.found;
        } else {
            const auto save = [&](std::int64_t frame, ChannelImage picture) {
                keep_channels(picture);
                write_exr(store_.picture(name, frame), picture);
            };
            const auto frames = static_cast<double>(scene.frames.size());
            run.frames = render_run(own.scene, own.settings, scene.frames, save,
                                    [&](double share) { show(share * frames, what); });
            store_.save(name, run.frames);
            ++results_.made;
        }
        done_ += static_cast<double>(scene.frames.size());
        show(0.0, what);
        for (const FrameRun& frame : run.frames) run.pictures.push_back(store_.picture(name, frame.frame).string());
        return run;
    }

    /// Compares its pictures with the references: from the files, so that a study that went on has the numbers of one
    /// that was never stopped.
    /// @param exact  the pictures were made from the references: noise of these is no part of their differences
    void measure(std::size_t s, MeasuredRun& run, bool exact) const {
        std::vector<ChannelImage> references = references_[s];
        for (ChannelImage& reference : references) {
            std::erase_if(reference.channels, [&](const Channel& channel) {
                return exact && (channel.name.starts_with("noise.") || channel.name == "variance.Y");
            });
        }
        const std::span<const JudgingFrame> frames = frames_of(s);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            run.errors.push_back(
                measure_errors(read_image(run.pictures[i]), references[i], frames[i].thresholds, prepared_.metrics));
        }
        std::vector<MetricValues> seen = measure_visible(
            frames, [&](std::size_t i) { return std::pair(read_image(run.pictures[i]), references[i]); });
        for (std::size_t i = 0; i < seen.size(); ++i) run.errors[i].merge(seen[i]);
    }

    static std::string identity(const SceneWithSettings& own, const std::vector<int>& frames) {
        return fmt::format("{} frames {} threads {} {}", hash_scene(own.scene), fmt::join(frames, ","), thread_count(),
                           name_settings(setting_map(own.settings)));
    }

    static void keep_channels(ChannelImage& picture) {
        constexpr const char* kept[] = {"R",      "G",       "B",         "A",         "indirect.", "error.",
                                        "cache.", "aleph.Y", "alpha.acc", "samples.Y", "records.Y", "effects."};
        std::erase_if(picture.channels, [&](const Channel& channel) {
            return std::ranges::none_of(kept, [&](std::string_view name) {
                return name.ends_with('.') ? channel.name.starts_with(name) : channel.name == name;
            });
        });
    }

    const PreparedStudy& prepared_;
    const Study& study_;
    RunStore store_;
    const StudyProgress& progress_;
    double work_ = 0.0, done_ = 0.0;                     ///< in runs of a frame
    std::vector<std::vector<ChannelImage>> references_;  ///< of the frames of each scene
    StudyResults results_;
};

}  // namespace

StudyResults run_study(const PreparedStudy& prepared, const std::filesystem::path& folder,
                       const StudyProgress& progress) {
    return StudyRunner(prepared, folder, progress).run();
}

StudyCount count_finished(const PreparedStudy& prepared, const std::filesystem::path& folder) {
    return StudyRunner(prepared, folder, {}).count_finished();
}

void make_part(const PreparedStudy& prepared, const std::filesystem::path& folder, const StudyPart& part,
               const StudyProgress& progress) {
    StudyRunner(prepared, folder, progress).make_part(part);
}

}  // namespace aleph
