#pragma once
// The cost of reading a file, counted: hostile files must end within limits.

#include "engine/json/load_limits.h"
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

/// At most the limit's memory at one time, which is 512 MiB, and work for about two seconds, told by the allocations;
/// less in proportion where the limit is lower.
inline void expect_bounded(const LoadCost& cost, const std::string& name, const LoadLimits& limits = {}) {
    EXPECT_LT(cost.memory.peak, limits.memory) << name;
    EXPECT_LT(cost.memory.calls, 24 * (limits.memory >> 20) * 1'000'000 / 512) << name;
    EXPECT_LT(cost.memory.bytes, 8 * limits.memory) << name;
}

}  // namespace aleph
