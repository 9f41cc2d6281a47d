#pragma once
// A table that is printed row by row, for reading or as Markdown.

#include <string>
#include <vector>

namespace aleph {

class StudyTable {
  public:
    /// Prints the head. Columns are right-aligned, the first `texts` of them left-aligned.
    StudyTable(std::vector<std::string> columns, int texts, bool markdown);

    /// One cell per column.
    void add(const std::vector<std::string>& cells) const;

  private:
    void print(const std::vector<std::string>& cells) const;

    std::vector<std::string> columns_;
    int texts_;
    bool markdown_;
};

}  // namespace aleph
