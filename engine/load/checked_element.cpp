#include "engine/load/checked_element.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/scene/components.h"
#include "engine/scene/operations.h"
#include "engine/scene_file/tracks.h"
#include "engine/surface/shapes.h"

namespace aleph {

CheckedElement::CheckedElement(const Scene& scene, const char* kind, std::size_t index, const std::string& name)
    : scene_(scene), place_(fmt::format("{} {}", kind, index)) {
    if (!name.empty()) place_ += fmt::format(" \"{}\"", printable(name));
}

void CheckedElement::check_index(int index, std::size_t count, const char* what, bool optional) const {
    if (optional && index == no_index) return;
    if (index >= 0 && static_cast<std::size_t>(index) < count) return;
    refuse(fmt::format("refers to {} {}, but there {} {}", what, index, count == 1 ? "is" : "are",
                       count == 0 ? "none" : fmt::format("only {}", count)));
}

void CheckedElement::check_sizes(std::span<const double> numbers) const {
    for (const double number : numbers)
        if (!any_value.holds(number)) refuse(fmt::format("a number of it {}", describe_outside(any_value, number)));
}

template <class T>
void CheckedElement::check_track(const Track<T>& track) const {
    validate(track, scene_.source.file, place_);
    for (const T& value : track.values) check_sizes(components(value));
}
template void CheckedElement::check_track(const Track<double>&) const;
template void CheckedElement::check_track(const Track<glm::dvec3>&) const;
template void CheckedElement::check_track(const Track<glm::dquat>&) const;
template void CheckedElement::check_track(const Track<glm::dmat4>&) const;

void CheckedElement::check_track(const OperationStack& stack) const {
    if (stack.operations.empty()) return;
    const std::size_t width = channel_count(stack);
    require(!stack.channels.empty() && stack.channels.size() % width == 0,
            "its operations need as many channels for every sample");
    check_sizes(stack.channels);
    check_sampling(stack.sampling, sample_count(stack));
}

void CheckedElement::check_sampling(const TimeSampling& sampling, std::size_t count) const {
    validate(sampling, count, scene_.source.file, place_);
}

void CheckedElement::check_shape(const Shape& shape) const {
    validate(shape, scene_.source.file, place_);
}

void CheckedElement::check_axis(const std::optional<AxisRotation>& rotation) const {
    constexpr double unit_tolerance = 1e-6;
    if (!rotation) return;
    const double length = glm::length(rotation->axis);
    if (std::abs(length - 1.0) <= unit_tolerance) return;
    refuse(fmt::format("the axis of its rotation has length {}; it has to be a unit vector", length));
}

void CheckedElement::check_texture(const char* key, const TextureRef& texture, std::size_t images) const {
    check_index(texture.image, images, "image");
    if (texture.uv_set != 0 && texture.uv_set != 1)
        refuse(fmt::format("{}: texture coordinates 0 and 1 exist, not {}", key, texture.uv_set));
    for (const double number :
         {texture.uv_offset.x, texture.uv_offset.y, texture.uv_scale.x, texture.uv_scale.y, texture.uv_rotation})
        check_number(key, number, any_value);
}

std::string CheckedElement::name_key(const char* name, std::size_t key, std::size_t count) {
    return count == 1 ? name : fmt::format("key {} of {}", key, name);
}

void CheckedElement::check_number(const char* key, double value, const ValueRange& range) const {
    if (!range.holds(value)) refuse(fmt::format("{} {}", key, describe_outside(range, value)));
}

template <class T>
void CheckedElement::check_keys(const char* key, const Track<T>& track, const ValueRange& range) const {
    for (std::size_t i = 0; i < track.key_count(); ++i)
        for (const double value : components(key_value(track, i)))
            if (!range.holds(value))
                refuse(fmt::format("{} {}", name_key(key, i, track.key_count()), describe_outside(range, value)));
}
template void CheckedElement::check_keys(const char*, const Track<double>&, const ValueRange&) const;
template void CheckedElement::check_keys(const char*, const Track<glm::dvec3>&, const ValueRange&) const;

void CheckedElement::check_angles(const char* key, const Track<double>& track, const ValueRange& range) const {
    const ValueRange radians = in_radians(range);
    for (std::size_t i = 0; i < track.key_count(); ++i) {
        const double value = key_value(track, i);
        if (radians.holds(value)) continue;
        const double degrees = exact_degrees(value).value_or(value * 180.0 / std::numbers::pi);
        refuse(fmt::format("{} {} degrees", name_key(key, i, track.key_count()), describe_outside(range, degrees)));
    }
}

void CheckedElement::check_words(const char* key, const Track<double>& track, int highest) const {
    for (std::size_t i = 0; i < track.key_count(); ++i) {
        const double value = key_value(track, i);
        if (value >= 0.0 && value <= highest && value == std::floor(value)) continue;
        refuse(fmt::format("{} has to be {}, found {}", name_key(key, i, track.key_count()),
                           highest == 1 ? "0 or 1" : "0, 1 or 2", value));
    }
}

}  // namespace aleph
