#pragma once
// Alembic's transforms at a time: channels are interpolated one by one, then the matrix is built.

#include <cstddef>
#include <glm/mat4x4.hpp>

#include "engine/scene/scene.h"

namespace aleph {

/// Channels that an operation takes.
std::size_t channel_count(OperationStack::Kind kind);

/// Channels of one sample of the whole stack.
std::size_t channel_count(const OperationStack& stack);

/// Samples that the stack holds; 0 where it has no operations.
std::size_t sample_count(const OperationStack& stack);

/// The local transform, column vectors. Exactly a sample's matrix on the sample, the first's before and the last's
/// after; identity where there are no operations. Equal neighbours give that very matrix at every time between them.
/// A rotation about an axis of length 0 does not turn.
glm::dmat4 evaluate(const OperationStack& stack, double seconds);

/// True where samples from the first to the last differ.
bool do_samples_differ(const OperationStack& stack, std::size_t first, std::size_t last);

/// False only where evaluate gives the same matrix at every time.
inline bool is_animated(const OperationStack& stack) {
    return sample_count(stack) > 1 && do_samples_differ(stack, 0, sample_count(stack) - 1);
}

}  // namespace aleph
