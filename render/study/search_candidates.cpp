#include "render/study/search_candidates.h"

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

}  // namespace aleph
