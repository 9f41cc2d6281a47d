#pragma once
// A raster of values: row 0 on top, x to the right.

#include <cstddef>
#include <vector>

namespace aleph {

template <class T>
struct Image {
    int width = 0;
    int height = 0;
    std::vector<T> pixels;  ///< row by row, `width * height` values

    Image() = default;
    Image(int w, int h, const T& value = T{})
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

    T& operator()(int x, int y) { return pixels[index(x, y)]; }
    const T& operator()(int x, int y) const { return pixels[index(x, y)]; }

    T* row(int y) { return pixels.data() + index(0, y); }
    const T* row(int y) const { return pixels.data() + index(0, y); }

    std::size_t size() const { return pixels.size(); }
    bool empty() const { return pixels.empty(); }

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }

    bool operator==(const Image&) const = default;
};

template <class A, class B>
bool same_size(const Image<A>& a, const Image<B>& b) {
    return a.width == b.width && a.height == b.height;
}

}  // namespace aleph
