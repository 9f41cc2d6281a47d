#pragma once
// Checks of random estimates in two stages. One seed and 3 standard errors first: of 370 right estimates one fails.
// Then other seeds, four times the samples and 4.5 standard errors: of 150,000 right estimates one fails, and a wrong
// one that failed the first stage is as good as certain to fail again.

#include <source_location>

#include "tests/support/test.h"

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

/// One stage of a check: what it varies, and what it finds wrong.
class Trial {
  public:
    using Place = std::source_location;

    std::uint32_t seed = 0;  ///< to be added to every seed
    double limit = 3.0;      ///< standard errors

    Trial() = default;
    static Trial second() {
        Trial trial;
        trial.seed = 1'000'003;
        trial.limit = 4.5;
        trial.factor_ = 4;
        return trial;
    }

    /// So many samples or seeds in the first stage.
    template <class Count>
    Count times(Count count) const {
        return count * static_cast<Count>(factor_);
    }

    void near(const Mean& found, double expected, double slack = 0.0, Place place = Place::current()) {
        near(found.mean(), found.error(), expected, slack, place);
    }
    void near(const Mean& a, const Mean& b, double slack = 0.0, Place place = Place::current()) {
        near(a.mean(), std::hypot(a.error(), b.error()), b.mean(), slack, place);
    }
    void near(double found, double error, double expected, double slack, Place place = Place::current()) {
        judge(std::abs(found - expected) <= limit * error + slack, found, error, expected, place);
    }
    void at_most(const Mean& found, double bound, Place place = Place::current()) {
        at_most(found.mean(), found.error(), bound, place);
    }
    void at_most(double found, double error, double bound, Place place = Place::current()) {
        judge(found <= bound + limit * error, found, error, bound, place);
    }
    /// A share of `all` independent events is expected.
    void counts(double found, double all, double share, double slack = 0.0, Place place = Place::current()) {
        near(found, std::sqrt(share * (1.0 - share) * all), share * all, slack, place);
    }

    const std::string& faults() const { return faults_; }

  private:
    void judge(bool good, double found, double error, double expected, Place place) {
        if (good) return;
        std::ostringstream text;
        text << "line " << place.line() << ": " << found << " +- " << error << ", not " << expected << '\n';
        faults_ += text.str();
    }

    int factor_ = 1;
    std::string faults_;
};

/// Calls check(Trial&) once or twice.
template <class Check>
testing::AssertionResult holds(const Check& check) {
    Trial first;
    check(first);
    if (first.faults().empty()) return testing::AssertionSuccess();
    Trial second = Trial::second();
    check(second);
    if (second.faults().empty()) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "first stage:\n" << first.faults() << "second stage:\n" << second.faults();
}

}  // namespace aleph
