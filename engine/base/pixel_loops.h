#pragma once
// Loops over the pixels of an image.

#include <algorithm>
#include <type_traits>

#include "engine/base/image.h"
#include "engine/base/parallel.h"

namespace aleph {

/// Calls visit(x, y) for all pixels, on any thread.
/// @param rows_per_chunk  at least 1
template <class T, class Visit>
void parallel_pixels(const Image<T>& image, int rows_per_chunk, const Visit& visit) {
    parallel_rows(image.height, rows_per_chunk, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < image.width; ++x) visit(x, y);
        }
    });
}

/// The image of value(a, b, ...) for the pixels a, b, ... of images of one size.
template <class Value, class A, class... Others>
auto map_pixels(const Value& value, const Image<A>& first, const Image<Others>&... others) {
    Image<std::invoke_result_t<Value, const A&, const Others&...>> out(first.width, first.height);
    for (std::size_t i = 0; i < out.size(); ++i) out.pixels[i] = value(first.pixels[i], others.pixels[i]...);
    return out;
}

/// Calls visit(x, y), row by row, for the pixels that are within `reach` of one along rows and columns, itself too.
template <class T, class Visit>
void visit_around(const Image<T>& image, int x, int y, int reach, const Visit& visit) {
    for (int ny = std::max(0, y - reach); ny <= std::min(image.height - 1, y + reach); ++ny) {
        for (int nx = std::max(0, x - reach); nx <= std::min(image.width - 1, x + reach); ++nx) visit(nx, ny);
    }
}

}  // namespace aleph
