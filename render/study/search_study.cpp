#include "render/study/search_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/sampling.h"

namespace aleph {

namespace {

constexpr int first_frames = 3;  // of the first round: enough for flicker

/// Deals the values of a setting: each once, in random order, before any comes again.
class Deck {
  public:
    Deck(std::size_t values, std::uint64_t key) : cards_(values), dealt_(values), key_(mix_bits(key)) {
        for (std::size_t i = 0; i < values; ++i) cards_[i] = i;
    }

    std::size_t deal() {
        if (dealt_ == cards_.size()) {
            for (std::size_t left = cards_.size(); left > 1; --left)
                std::swap(cards_[left - 1], cards_[mix_bits(key_ += 0x9e3779b97f4a7c15ull) % left]);
            dealt_ = 0;
        }
        return cards_[dealt_++];
    }

  private:
    std::vector<std::size_t> cards_;
    std::size_t dealt_;
    std::uint64_t key_;
};

/// The settings that are rendered: without those that have no effect.
SettingMap make_candidate(const Study& study, SettingMap settings) {
    SettingMap all = settings;
    all.insert(study.settings.begin(), study.settings.end());
    const auto guide = all.find("guide");
    if (guide != all.end() && guide->second == SettingValue(std::string("none"))) {
        settings.erase("adapter");
        settings.erase("adapter_k");
    }
    const auto accuracy = all.find("accuracy");
    if (accuracy != all.end() && accuracy->second == SettingValue(0.0)) {  // nothing is kept that these speak of
        for (const char* const key : {"gather", "light_step", "adapter", "adapter_k"}) settings.erase(key);
        settings["guide"] = std::string("none");
    }
    settings["sampling"] = std::string("uniform");
    settings["error"] = 0.0;
    return settings;
}

/// The part of a list that has the most neighbours; the first of several.
std::vector<int> pick_frames(const std::vector<int>& frames, std::size_t count) {
    std::size_t best = 0;
    int most = -1;
    for (std::size_t begin = 0; begin + count <= frames.size(); ++begin) {
        int neighbours = 0;
        for (std::size_t i = begin + 1; i < begin + count; ++i) neighbours += frames[i] == frames[i - 1] + 1 ? 1 : 0;
        if (neighbours > most) {
            most = neighbours;
            best = begin;
        }
    }
    const auto begin = frames.begin() + static_cast<std::ptrdiff_t>(best);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

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

StudySearch default_search() {
    using Text = std::string;
    StudySearch search;
    search.settings = {{"guide", {Text("none"), Text("saliency")}},
                       {"adapter", {Text("compress"), Text("scale-add")}},
                       {"accuracy", {0.0, 0.05, 0.1, 0.15, 0.3, 0.5}},
                       {"gather", {64.0, 128.0, 256.0, 512.0}},
                       {"spp", {4.0, 8.0, 16.0, 32.0, 64.0, 128.0}},
                       {"light_samples", {1.0, 4.0}},
                       {"light_step", {0.0, 5.0, 10.0}}};
    return search;
}

std::vector<StudyVariant> list_candidates(const Study& study) {
    const std::vector<StudyAxis>& axes = study.search->settings;
    const auto wanted = static_cast<std::size_t>(study.search->candidates);
    std::vector<StudyVariant> candidates;
    std::set<SettingMap> known;
    const auto add = [&](SettingMap choice) {
        SettingMap settings = make_candidate(study, std::move(choice));
        if (known.insert(settings).second)
            candidates.push_back({fmt::format("fixed {}", candidates.size() + 1), std::move(settings)});
    };
    double combinations = 1.0;
    std::vector<Deck> decks;
    for (const StudyAxis& axis : axes) {
        combinations *= static_cast<double>(axis.values.size());
        decks.emplace_back(axis.values.size(), decks.size());
    }
    if (combinations <= static_cast<double>(wanted)) {
        std::ranges::for_each(list_combinations(axes), add);
        return candidates;
    }
    const std::size_t most_deals = 100 * wanted;  // where most combinations are equal ones
    for (std::size_t i = 0; i < most_deals && candidates.size() < wanted; ++i) {
        SettingMap choice;
        for (std::size_t axis = 0; axis < axes.size(); ++axis)
            choice[axes[axis].setting] = axes[axis].values[decks[axis].deal()];
        add(std::move(choice));
    }
    return candidates;
}

std::vector<SearchRound> plan_rounds(int rounds, std::size_t candidates, int width, int height,
                                     const std::vector<int>& frames) {
    std::vector<SearchRound> plan;
    const auto all = static_cast<double>(frames.size());
    const double fewest = std::min<double>(first_frames, all);
    for (int round = 0; round < rounds; ++round) {
        const double share = rounds > 1 ? static_cast<double>(round) / (rounds - 1) : 1.0;
        const double scale = std::pow(0.5, 1.0 - share);
        const auto count = static_cast<std::size_t>(std::lround(fewest * std::pow(all / fewest, share)));
        const auto side = [&](int full) { return std::max(1, static_cast<int>(std::lround(full * scale))); };
        plan.push_back({candidates, side(width), side(height), pick_frames(frames, count)});
        candidates = (candidates + 1) / 2;
    }
    return plan;
}

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
