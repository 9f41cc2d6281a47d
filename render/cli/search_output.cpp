#include "render/cli/search_output.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>

#include "engine/base/errors.h"
#include "render/cli/study_output.h"
#include "render/study/search_study.h"

namespace aleph {

namespace {

constexpr std::array shares_seen = {1.0, 5.0};  // percent, for which the best settings are told

/// Without what all candidates have.
std::string describe_settings(const PreparedStudy& prepared, SettingMap settings) {
    settings.erase("sampling");
    settings.erase("error");
    return name_settings(settings, prepared.study.search->settings);
}

void print_best(const PreparedStudy& prepared, const SceneSearch& scene, std::ostream& out) {
    std::vector<CostPoint> points;
    for (const SearchedPoint& point : scene.front) points.push_back(point.point);
    fmt::print(out, "Best fixed settings of {}, of {} candidates:\n", printable(scene.scene),
               prepared.candidates.size());
    for (const double share : shares_seen) {
        if (const auto best = find_cheapest(points, share)) {
            const SearchedPoint& found = scene.front[*best];
            fmt::print(out, "  at most {:.0f} % seen: {:.3g} s, {:.2g} % seen: {}: {}\n", share, found.point.cost,
                       found.point.error, found.variant, printable(describe_settings(prepared, found.settings), 400));
        } else {
            fmt::print(out, "  at most {:.0f} % seen: none; the best is {}: {:.3g} s, {:.2g} % seen: {}\n", share,
                       scene.front.back().variant, points.back().cost, points.back().error,
                       printable(describe_settings(prepared, scene.front.back().settings), 400));
        }
    }
}

void print_against(const AgainstFixed& against, std::ostream& out) {
    const CostPoint& own = against.own.point;
    const double ratio = against.fixed.cost / std::max(own.cost, 1e-9);
    const std::string name = printable(against.own.variant, 80);
    switch (against.fixed.bound) {
        case FrontCost::Bound::between:
            fmt::print(
                out, "  {}: {:.3g} s, {:.2g} % seen; fixed settings take {:.3g} s for as much: {:.2f} times as long\n",
                name, own.cost, own.error, against.fixed.cost, ratio);
            break;
        case FrontCost::Bound::at_most:
            fmt::print(out,
                       "  {}: {:.3g} s, {:.2g} % seen; all fixed settings that were kept show less: at most {:.3g} s, "
                       "{:.2f} times as long\n",
                       name, own.cost, own.error, against.fixed.cost, ratio);
            break;
        case FrontCost::Bound::more:
            fmt::print(out,
                       "  {}: {:.3g} s, {:.2g} % seen; no fixed settings that were kept show as little: more than "
                       "{:.3g} s, {:.2f} times as long\n",
                       name, own.cost, own.error, against.fixed.cost, ratio);
            break;
    }
}

}  // namespace

void print_search(const PreparedStudy& prepared, const StudyResults& results, bool markdown, std::ostream& out) {
    print_head(prepared, results, out);
    fmt::print(out, "Means over the frames of a scene; * no other variant is faster and better in this scene.\n");
    for (const SceneSearch& scene : summarize_search(prepared, results)) {
        fmt::print(out, "\n{}\n\n", printable(scene.scene));
        print_table(prepared, variants_of_scene(results, scene.scene), markdown, out);
        out << "\n";
        print_best(prepared, scene, out);
        if (!scene.against.empty()) out << "The study's variants beside them:\n";
        for (const AgainstFixed& against : scene.against) print_against(against, out);
    }
}

}  // namespace aleph
