#pragma once
// The cost of reading a file, counted: hostile files must end within limits.

#include "tests/support/allocations.h"
#include "tests/support/test.h"

namespace aleph {

struct LoadCost {
    Refusal refusal;
    Allocations memory;

    bool refused() const { return !refusal.message.empty(); }
};

/// Any exception but an InputError passes through.
inline LoadCost load_cost(const std::function<void()>& work) {
    LoadCost cost;
    cost.memory = count_allocations([&] { cost.refusal = find_refusal(work); });
    return cost;
}

/// At most 512 MiB at one time, and work for about two seconds, told by the allocations.
inline void expect_bounded(const LoadCost& cost, const std::string& name) {
    EXPECT_LT(cost.memory.peak_mebibytes(), 512.0) << name;
    EXPECT_LT(cost.memory.calls, 24'000'000u) << name;
    EXPECT_LT(cost.memory.bytes, std::size_t{4} << 30) << name;
}

}  // namespace aleph
