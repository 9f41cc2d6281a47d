#include "render/study/search_study.h"

#include <fmt/format.h>

#include <algorithm>

namespace aleph {

namespace {

/// Pixels to render: for progress alone.
double work_of(const PreparedStudy& prepared, const SearchRound& round) {
    constexpr double renderings_per_pass = 4.0;
    return static_cast<double>(round.width) * round.height * static_cast<double>(round.frames.size()) *
           (static_cast<double>(round.candidates) + renderings_per_pass * prepared.study.reference.passes);
}

/// The study of one round: one scene, in the round's size and frames, in the variants that are left.
PreparedStudy study_of(const PreparedStudy& prepared, const PreparedStudyScene& scene, const SearchRound& round,
                       std::vector<StudyVariant> variants) {
    PreparedStudy small{prepared.study, std::move(variants), prepared.metrics, {scene}, {}};
    small.study.settings["size"] = fmt::format("{}x{}", round.width, round.height);
    small.scenes.front().frames = round.frames;
    return small;
}

/// Adds the results of a scene.
void merge(StudyResults scene, StudyResults& all) {
    std::ranges::move(scene.frames, std::back_inserter(all.frames));
    all.made += scene.made;
    all.found += scene.found;
    for (VariantResult& variant : scene.variants) {
        const auto known = std::ranges::find(all.variants, variant.name, &VariantResult::name);
        if (known == all.variants.end()) {
            all.variants.push_back(std::move(variant));
            continue;
        }
        std::ranges::move(variant.frames, std::back_inserter(known->frames));
        known->on_front = known->on_front || variant.on_front;
    }
}

class Search {
  public:
    Search(const PreparedStudy& prepared, const std::filesystem::path& folder, const StudyProgress& progress)
        : prepared_(prepared), folder_(folder), progress_(progress) {
        for (const PreparedStudyScene& scene : prepared.scenes) {
            for (const SearchRound& round : rounds_of(prepared, scene)) work_ += work_of(prepared, round);
        }
    }

    StudyResults run() {
        for (const PreparedStudyScene& scene : prepared_.scenes) merge(search(scene), results_);
        std::ranges::for_each(results_.variants, average_frames);
        results_.judges = prepared_.study.judges;
        return std::move(results_);
    }

  private:
    StudyResults search(const PreparedStudyScene& scene) {
        const std::vector<SearchRound> rounds = rounds_of(prepared_, scene);
        std::vector<StudyVariant> left = prepared_.candidates;
        for (std::size_t r = 0; r + 1 < rounds.size(); ++r) {
            PreparedStudy study = study_of(prepared_, scene, rounds[r], left);
            study.study.runs.repeats = 1;
            study.study.runs.seeds.resize(1);
            const StudyResults results = run_round(study, r, rounds[r]);
            results_.made += results.made;
            results_.found += results.found;
            std::vector<CostPoint> points;
            for (const VariantResult& variant : results.variants) points.push_back(find_point(variant).value());
            std::vector<StudyVariant> kept;
            for (const std::size_t i : keep_best(points, rounds[r + 1].candidates)) kept.push_back(std::move(left[i]));
            left = std::move(kept);
        }
        std::vector<StudyVariant> last = prepared_.variants;
        std::ranges::move(left, std::back_inserter(last));
        return run_round(study_of(prepared_, scene, rounds.back(), std::move(last)), rounds.size() - 1, rounds.back());
    }

    StudyResults run_round(const PreparedStudy& study, std::size_t number, const SearchRound& round) {
        const double work = work_of(prepared_, round);
        StudyResults results = run_study(study, folder_, [&](double share, const std::string& what) {
            if (!progress_) return;
            progress_(std::min(1.0, (done_ + share * work) / work_), fmt::format("round {}, {}", number + 1, what));
        });
        done_ += work;
        return results;
    }

    const PreparedStudy& prepared_;
    const std::filesystem::path& folder_;
    const StudyProgress& progress_;
    double work_ = 0.0, done_ = 0.0;
    StudyResults results_;
};

}  // namespace

std::vector<SearchRound> rounds_of(const PreparedStudy& prepared, const PreparedStudyScene& scene) {
    const PictureSettings picture = with_settings_of(scene, prepared.study, {}).settings.picture;
    return plan_rounds(prepared.study.search->rounds, prepared.candidates.size(), picture.width, picture.height,
                       scene.frames);
}

StudyResults search_study(const PreparedStudy& prepared, const std::filesystem::path& folder,
                          const StudyProgress& progress) {
    return Search(prepared, folder, progress).run();
}

std::vector<VariantResult> variants_of_scene(const StudyResults& results, const std::string& scene) {
    std::vector<VariantResult> variants;
    for (const VariantResult& variant : results.variants) {
        VariantResult own{variant.name, variant.settings, {}, {}, false};
        std::ranges::copy_if(variant.frames, std::back_inserter(own.frames),
                             [&](const FrameResult& frame) { return frame.scene == scene; });
        if (own.frames.empty()) continue;
        average_frames(own);
        variants.push_back(std::move(own));
    }
    find_front(variants);
    return variants;
}

std::vector<SceneSearch> summarize_search(const PreparedStudy& prepared, const StudyResults& results) {
    std::vector<SceneSearch> summaries;
    for (const PreparedStudyScene& scene : prepared.scenes) {
        SceneSearch& summary = summaries.emplace_back();
        summary.scene = scene.name;
        std::vector<SearchedPoint> fixed, own;
        for (const VariantResult& variant : variants_of_scene(results, scene.name)) {
            const std::optional<CostPoint> point = find_point(variant);
            if (!point) continue;  // pictures from elsewhere, or noise, take no seconds
            const bool searched =
                std::ranges::find(prepared.candidates, variant.name, &StudyVariant::name) != prepared.candidates.end();
            (searched ? fixed : own).push_back({variant.name, variant.settings, *point});
        }
        std::vector<CostPoint> points;
        for (const SearchedPoint& point : fixed) points.push_back(point.point);
        for (const std::size_t i : list_front(points)) summary.front.push_back(fixed[i]);
        for (SearchedPoint& point : own) {
            const FrontCost cost = interpolate_front(points, point.point.error);
            summary.against.push_back({std::move(point), cost});
        }
    }
    return summaries;
}

}  // namespace aleph
