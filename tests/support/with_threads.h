#pragma once
// Any number of threads, also on a machine with fewer cores.

#include "engine/base/parallel.h"

#if !defined(ALEPH_STD_THREADS)
#include <tbb/task_arena.h>
#endif

namespace aleph {

/// Calls work() with that many threads to share it, also where the machine has fewer cores.
template <class Work>
auto with_threads(int threads, const Work& work) {
    const ThreadLimit limit(threads);
#if defined(ALEPH_STD_THREADS)
    return work();
#else
    tbb::task_arena arena(threads);
    return arena.execute(work);
#endif
}

}  // namespace aleph
