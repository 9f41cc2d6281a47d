#pragma once
// What reading a file costs, counted: hostile files must end within limits.

#include <gtest/gtest.h>

#include <string>

#include "engine/base/errors.h"
#include "tests/support/allocations.h"

namespace aleph {

struct LoadCost {
    bool refused = false;  ///< with an InputError
    std::string message;   ///< of the InputError
    Allocations memory;
};

/// Any exception but an InputError passes through.
inline LoadCost load_cost(const std::function<void()>& work) {
    LoadCost cost;
    cost.memory = count_allocations([&] {
        try {
            work();
        } catch (const InputError& error) {
            cost.refused = true;
            cost.message = error.what();
        }
    });
    return cost;
}

/// At most 512 MiB at one time, and work for about two seconds, told by the allocations.
inline void expect_bounded(const LoadCost& cost, const std::string& name) {
    EXPECT_LT(cost.memory.peak_mebibytes(), 512.0) << name;
    EXPECT_LT(cost.memory.calls, 24'000'000u) << name;
    EXPECT_LT(cost.memory.bytes, std::size_t{4} << 30) << name;
}

}  // namespace aleph
