#pragma once
// What ways to choose accuracies save, over several frames.

#include <string>
#include <vector>

namespace aleph {

/// Times fewer rays than the best uniform accuracy, in one frame at one share of pixels beyond so many thresholds.
struct Saving {
    std::string vision, thresholds, adapter, percent;
    double ratio = 1.0;
};

/// A table of geometric means over the frames.
void print_means(const std::vector<Saving>& savings, bool markdown);

}  // namespace aleph
