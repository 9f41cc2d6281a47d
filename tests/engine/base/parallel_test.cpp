// parallel_for visits every index once, in fixed chunks, and passes exceptions on.

#include "engine/base/parallel.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(Parallel, EveryIndexOnceInFixedChunks) {
    for (const int threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        std::vector<int> visits(1003, 0), chunk_starts(1003, -1);
        parallel_for(visits.size(), 10, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                ++visits[i];
                chunk_starts[i] = static_cast<int>(begin);
            }
        });
        for (std::size_t i = 0; i < visits.size(); ++i) {
            ASSERT_EQ(visits[i], 1);
            ASSERT_EQ(chunk_starts[i], static_cast<int>(i / 10 * 10));
        }
    }
}

TEST(Parallel, ExceptionsReachTheCaller) {
    EXPECT_THROW(parallel_for(100, 1,
                              [](std::size_t begin, std::size_t) {
                                  if (begin == 37) throw std::runtime_error("37");
                              }),
                 std::runtime_error);
}

TEST(Parallel, NothingToDo) {
    parallel_for(0, 1, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(Parallel, DT06_DenormalsAreFlushedInEveryChunkAndRestoredAfter) {
    const volatile float tiny = 1e-39f;
    std::vector<float> doubled(64, -1.0f);
    parallel_for(doubled.size(), 1, [&](std::size_t begin, std::size_t) { doubled[begin] = tiny * 2.0f; });
    for (const float value : doubled) EXPECT_EQ(value, 0.0f);
    EXPECT_GT(tiny * 2.0f, 0.0f);
}

}  // namespace
}  // namespace aleph
