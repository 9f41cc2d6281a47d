#pragma once
// Means with their standard errors.

#include <cmath>
#include <cstddef>

namespace aleph {

/// The mean of independent values.
class Mean {
  public:
    void add(double value) {
        ++count_;
        const double delta = value - mean_;
        mean_ += delta / static_cast<double>(count_);
        squares_ += delta * (value - mean_);
    }
    double mean() const { return mean_; }
    double error() const {
        const double n = static_cast<double>(count_);
        return std::sqrt(squares_ / (n * (n - 1.0)));
    }

  private:
    std::size_t count_ = 0;
    double mean_ = 0.0, squares_ = 0.0;
};

}  // namespace aleph
