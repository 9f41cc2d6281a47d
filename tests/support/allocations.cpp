// Counts allocations in front of the C library's own allocator.

#include "tests/support/allocations.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cerrno>

namespace {

std::atomic<std::size_t> calls, bytes, peak;
std::atomic<std::ptrdiff_t> held;

[[maybe_unused]] void* taken(void* block) {
    if (!block) return block;
    const std::size_t size = malloc_usable_size(block);
    calls.fetch_add(1, std::memory_order_relaxed);
    bytes.fetch_add(size, std::memory_order_relaxed);
    const auto now = static_cast<std::ptrdiff_t>(size) + held.fetch_add(static_cast<std::ptrdiff_t>(size));
    std::size_t most = peak.load(std::memory_order_relaxed);
    while (now > static_cast<std::ptrdiff_t>(most) &&
           !peak.compare_exchange_weak(most, static_cast<std::size_t>(now))) {
    }
    return block;
}

[[maybe_unused]] void give_back(void* block) {
    if (block) held.fetch_sub(static_cast<std::ptrdiff_t>(malloc_usable_size(block)));
}

}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// The GNU C library lets a program replace its allocator by defining all of these.
extern "C" {
void* __libc_malloc(std::size_t) noexcept;
void* __libc_calloc(std::size_t, std::size_t) noexcept;
void* __libc_realloc(void*, std::size_t) noexcept;
void* __libc_memalign(std::size_t, std::size_t) noexcept;
void __libc_free(void*) noexcept;

void* malloc(std::size_t size) noexcept {
    return taken(__libc_malloc(size));
}
void* calloc(std::size_t count, std::size_t size) noexcept {
    return taken(__libc_calloc(count, size));
}
void* realloc(void* block, std::size_t size) noexcept {
    const auto before = static_cast<std::ptrdiff_t>(block ? malloc_usable_size(block) : 0);
    void* moved = __libc_realloc(block, size);
    if (moved || size == 0) held.fetch_sub(before);
    return taken(moved);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
    return taken(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    return taken(__libc_memalign(alignment, size));
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
    *block = taken(__libc_memalign(alignment, size));
    return *block ? 0 : ENOMEM;
}
void free(void* block) noexcept {
    give_back(block);
    __libc_free(block);
}
}
#endif

namespace aleph {

Allocations count_allocations(const std::function<void()>& work) {
    const std::ptrdiff_t held_before = held;
    const std::size_t calls_before = calls, bytes_before = bytes;
    peak = static_cast<std::size_t>(std::max<std::ptrdiff_t>(held_before, 0));
    work();
    if (!allocations_count) return {};
    return {calls - calls_before, bytes - bytes_before, peak - static_cast<std::size_t>(held_before)};
}

}  // namespace aleph
