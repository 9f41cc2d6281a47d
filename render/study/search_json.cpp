// What a search found, as JSON.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "render/study/search_study.h"
#include "render/study/study_files.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

Json point_json(const SearchedPoint& point) {
    return {{"variant", point.variant}, {"processor_seconds", point.point.cost}, {"share_seen", point.point.error}};
}

const char* name_of(FrontCost::Bound bound) {
    switch (bound) {
        case FrontCost::Bound::between:
            return "exact";
        case FrontCost::Bound::at_most:
            return "at most";
        case FrontCost::Bound::more:
            return "more than";
    }
    return "";
}

}  // namespace

Json search_json(const PreparedStudy& prepared, const StudyResults& results) {
    Json json{{"candidates", prepared.candidates.size()}, {"scenes", Json::array()}};
    const std::vector<SceneSearch> summaries = summarize_search(prepared, results);
    for (std::size_t s = 0; s < summaries.size(); ++s) {
        Json& scene = json["scenes"].emplace_back();
        scene = {{"scene", summaries[s].scene},
                 {"rounds", Json::array()},
                 {"front", Json::array()},
                 {"against", Json::array()}};
        for (const SearchRound& round : rounds_of(prepared, prepared.scenes[s])) {
            scene["rounds"].push_back({{"candidates", round.candidates},
                                       {"size", fmt::format("{}x{}", round.width, round.height)},
                                       {"frames", round.frames}});
        }
        for (const SearchedPoint& point : summaries[s].front) scene["front"].push_back(point_json(point));
        for (const AgainstFixed& against : summaries[s].against) {
            Json entry = point_json(against.own);
            entry["fixed_seconds"] = against.fixed.cost;
            entry["fixed_seconds_are"] = name_of(against.fixed.bound);
            scene["against"].push_back(std::move(entry));
        }
    }
    return json;
}

}  // namespace aleph
