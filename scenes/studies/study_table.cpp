#include "scenes/studies/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace aleph {

StudyTable::StudyTable(std::vector<std::string> columns, int texts, bool markdown)
    : columns_(std::move(columns)), texts_(texts), markdown_(markdown) {
    print(columns_);
    if (!markdown_) return;
    fmt::print("|");
    for (int i = 0; i < std::ssize(columns_); ++i) fmt::print("{}", i < texts_ ? " --- |" : " ---: |");
    fmt::print("\n");
}

void StudyTable::add(const std::vector<std::string>& cells) const {
    print(cells);
    std::cout << std::flush;
}

void StudyTable::print(const std::vector<std::string>& cells) const {
    if (markdown_) {
        fmt::print("| {} |\n", fmt::join(cells, " | "));
        return;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::size_t width = std::max<std::size_t>(columns_[i].size(), 8);
        if (static_cast<int>(i) < texts_) {
            fmt::print("{:<{}}  ", cells[i], width);
        } else {
            fmt::print("{:>{}}  ", cells[i], width);
        }
    }
    fmt::print("\n");
}

}  // namespace aleph
