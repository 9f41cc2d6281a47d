// Operation stacks against matrices on paper.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "engine/scene/operations.h"
#include "tests/support/numbers.h"

namespace aleph {
namespace {

using Kind = OperationStack::Kind;

glm::dvec3 apply(const OperationStack& stack, double seconds, const glm::dvec3& point) {
    return glm::dvec3(evaluate(stack, seconds) * glm::dvec4(point, 1.0));
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-15 * (1.0 + std::abs(b[i])));
}

TEST(OperationStack, NoOperationsAreTheIdentity) {
    EXPECT_EQ(evaluate(OperationStack{}, 3.0), glm::dmat4(1.0));
    EXPECT_FALSE(is_animated(OperationStack{}));
}

TEST(OperationStack, TheLastOperationActsFirst) {
    OperationStack stack;
    stack.operations = {Kind::translate, Kind::rotate_z, Kind::scale};
    stack.channels = {10.0, 20.0, 30.0, pi / 2.0, 2.0, 3.0, 4.0};
    expect_near(apply(stack, 0.0, {1.0, 1.0, 1.0}), {10.0 - 3.0, 20.0 + 2.0, 34.0});
}

TEST(OperationStack, RotationsAreRightHanded) {
    const auto turn = [](Kind kind, std::vector<double> channels, const glm::dvec3& point) {
        return apply({{kind}, {}, std::move(channels)}, 0.0, point);
    };
    expect_near(turn(Kind::rotate_x, {pi / 2.0}, {0, 1, 0}), {0, 0, 1});
    expect_near(turn(Kind::rotate_y, {pi / 2.0}, {0, 0, 1}), {1, 0, 0});
    expect_near(turn(Kind::rotate_z, {pi / 2.0}, {1, 0, 0}), {0, 1, 0});
    // A third of a turn about the diagonal passes x to y to z; the axis need not be unit.
    expect_near(turn(Kind::rotate, {7.0, 7.0, 7.0, 2.0 * pi / 3.0}, {1, 2, 3}), {3, 1, 2});
    expect_near(turn(Kind::rotate, {0.0, 0.0, 0.0, 1.0}, {1, 2, 3}), {1, 2, 3});
}

TEST(OperationStack, ChannelsInterpolateOneByOneAndHoldOutside) {
    OperationStack stack;
    stack.operations = {Kind::rotate_z, Kind::translate};
    stack.sampling.kind = TimeSampling::Kind::acyclic;
    stack.sampling.times = {1.0, 2.0, 4.0};
    stack.channels = {0.0, 1.0, 0.0, 0.0, /**/ 2.0 * pi, 3.0, 0.0, 0.0, /**/ 2.0 * pi, 3.0, 0.0, 0.0};
    expect_near(apply(stack, 1.5, {0, 0, 0}), {-2.0, 0.0, 0.0});  // half of a whole turn, half way out
    EXPECT_EQ(evaluate(stack, 0.0), evaluate(stack, 1.0));
    EXPECT_EQ(evaluate(stack, 9.0), evaluate(stack, 4.0));
    EXPECT_EQ(evaluate(stack, 2.7), evaluate(stack, 4.0));  // equal samples: the very matrix
    EXPECT_TRUE(is_animated(stack));
    stack.channels[4] = 0.0, stack.channels[5] = 1.0, stack.channels[8] = 0.0, stack.channels[9] = 1.0;
    EXPECT_FALSE(is_animated(stack));
}

TEST(OperationStack, AMatrixIsGivenColumnByColumn) {
    OperationStack stack;
    stack.operations = {Kind::matrix};
    stack.channels = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    expect_near(apply(stack, 0.0, {1, 1, 1}), {6, 7, 8});
    EXPECT_EQ(sample_count(stack), 1u);
}

}  // namespace
}  // namespace aleph
