#include "scenes/studies/saving.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scenes/studies/study_table.h"

namespace aleph {

void print_means(const std::vector<Saving>& savings, bool markdown) {
    const StudyTable table(
        {"vision", "thresholds", "accuracy from", "beyond (%)", "frames", "times fewer", "least", "most"}, 3, markdown);
    std::map<std::array<std::string, 4>, std::vector<double>> groups;
    for (const Saving& s : savings) groups[{s.vision, s.thresholds, s.adapter, s.percent}].push_back(s.ratio);
    for (const auto& [group, ratios] : groups) {
        double logarithms = 0.0;
        for (const double ratio : ratios) logarithms += std::log(ratio);
        const double mean = std::exp(logarithms / static_cast<double>(ratios.size()));
        const auto [least, most] = std::ranges::minmax(ratios);
        table.add({group[0], group[1], group[2], group[3], fmt::format("{}", ratios.size()),
                   fmt::format("{:.2f}", mean), fmt::format("{:.2f}", least), fmt::format("{:.2f}", most)});
    }
}

}  // namespace aleph
