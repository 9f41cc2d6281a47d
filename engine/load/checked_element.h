#pragma once
// One element of a scene that is checked: what is refused names it.

#include <optional>
#include <span>
#include <string>

#include "engine/base/errors.h"
#include "engine/scene/scene.h"
#include "engine/scene_file/fields.h"

namespace aleph {

class CheckedElement {
  public:
    /// @param kind  "node"
    CheckedElement(const Scene& scene, const char* kind, std::size_t index, const std::string& name);
    /// @param place  of what there is one of: "exposure"
    CheckedElement(const Scene& scene, std::string place) : scene_(scene), place_(std::move(place)) {}

    [[noreturn]] void refuse(const std::string& reason) const { throw InputError(scene_.source.file, place_, reason); }
    void require(bool holds, const char* reason) const {
        if (!holds) refuse(reason);
    }

    /// @param what  the kind of element that is referred to
    void check_index(int index, std::size_t count, const char* what, bool optional = true) const;
    template <class T>
    void check_track(const Track<T>& track) const;
    void check_track(const OperationStack& stack) const;
    void check_shape(const Shape& shape) const;
    void check_sampling(const TimeSampling& sampling, std::size_t count) const;
    void check_axis(const std::optional<AxisRotation>& rotation) const;
    /// @param images  how many there are
    void check_texture(const char* key, const TextureRef& texture, std::size_t images) const;

    /// Numbers in their ranges; tangents of cubic keys have none.
    void check_number(const char* key, double value, const ValueRange& range) const;
    template <class T>
    void check_keys(const char* key, const Track<T>& track, const ValueRange& range) const;
    /// A track of the words 0 to `highest`, such as visibility.
    void check_words(const char* key, const Track<double>& track, int highest) const;
    template <class Owner, class T, std::size_t count>
    void check(const Owner& owner, const std::array<TrackField<Owner, T>, count>& fields) const {
        for (const auto& field : fields) check_keys(field.key, field.in(owner), field.range);
    }
    template <class Owner, std::size_t count>
    void check(const Owner& owner, const std::array<Field<Owner, double>, count>& fields) const {
        for (const auto& field : fields) check_number(field.key, field.in(owner), field.range);
    }
    template <class Owner, std::size_t count>
    void check(const Owner& owner, const std::array<AngleField<Owner>, count>& fields) const {
        for (const auto& field : fields) check_angles(field.key, field.in(owner), field.range);
    }

  private:
    /// @param range  degrees
    void check_angles(const char* key, const Track<double>& track, const ValueRange& range) const;
    /// "key 3 of roughness"; a constant has no number.
    static std::string name_key(const char* name, std::size_t key, std::size_t count);
    /// Numbers within those of a file.
    void check_sizes(std::span<const double> numbers) const;

    const Scene& scene_;
    std::string place_;
};

}  // namespace aleph
