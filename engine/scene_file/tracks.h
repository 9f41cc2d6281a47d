#pragma once
// Values over time in scene files: constants, keys, uniform and cyclic samples. Writing keeps every bit.

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/json/json_ref.h"
#include "engine/scene_file/fields.h"

namespace aleph {

// Types and lengths were checked by the schema. All throw InputError with the pointer of a value outside its limits
// (tangents have none), of times that do not ascend, or of keys that exclude each other.
Track<double> read_number(const JsonRef& at, const FrameRate& rate, const ValueRange& range);
Track<glm::dvec3> read_vector(const JsonRef& at, const FrameRate& rate, const ValueRange& range);
Track<glm::dvec3> read_scale(const JsonRef& at, const FrameRate& rate);
Track<glm::dquat> read_quaternion(const JsonRef& at, const FrameRate& rate);
/// A rotation about a fixed axis, with degrees or radians; nothing where the value is no object with an axis: then it
/// is a quaternion.
std::optional<AxisRotation> read_axis_rotation(const JsonRef& at, const FrameRate& rate);
Track<glm::dmat4> read_matrix(const JsonRef& at, const FrameRate& rate);
/// false, true and "always" as 0, 1 and 2; step.
Track<double> read_visibility(const JsonRef& at, const FrameRate& rate);
/// Degrees in the file, radians in the track. @param range  degrees
Track<double> read_degrees(const JsonRef& at, const FrameRate& rate, const ValueRange& range);

/// The track with the tangents of the easing that the "interpolation" at `at` names; as it is where that names none,
/// and with a single key. Every component stays between its values at the two keys around it. Quaternions come back
/// unit, each with the sign that is nearer to the key before it.
/// The tangents of `smooth` are those of a parabola through the key and its neighbours, limited as by Steffen 1990,
/// Astronomy and Astrophysics 239, 443 (equations 8 and 11).
/// @param track  valid, linear. Instantiated for double, dvec3 and dquat
/// @throws InputError where keys are so near in time that a file cannot hold their tangents
template <class T>
Track<T> apply_easing(const JsonRef& at, Track<T> track);

/// Values of any kind over time: calls visit for each value of "keys" or "values" and returns their times.
TimeSampling read_samples(const JsonRef& at, const FrameRate& rate, const std::function<void(const JsonRef&)>& visit);

/// A number that does not change.
double read_plain(const JsonRef& at, const ValueRange& range);
template <class Fields, class Element>
void read_fields(const JsonRef& at, const Fields& fields, Element& element) {
    for (const auto& field : fields)
        if (const auto value = at.find(field.key)) field.in(element) = read_plain(*value, field.range);
}
glm::dvec3 read_dvec3(const JsonRef& at);
glm::dvec2 read_dvec2(const JsonRef& at);

// Conversions of the reader.
double to_radians(double degrees);
/// The shortest decimal of degrees that to_radians turns into exactly these radians; nothing if there is none.
std::optional<double> exact_degrees(double radians);

// Times are written in frames if all are whole frames, else in seconds. The track is valid (track.h).
nlohmann::ordered_json write_number(const Track<double>& track, const FrameRate& rate);
nlohmann::ordered_json write_vector(const Track<glm::dvec3>& track, const FrameRate& rate);
nlohmann::ordered_json write_scale(const Track<glm::dvec3>& track, const FrameRate& rate);
nlohmann::ordered_json write_quaternion(const Track<glm::dquat>& track, const FrameRate& rate);
nlohmann::ordered_json write_matrix(const Track<glm::dmat4>& track, const FrameRate& rate);
nlohmann::ordered_json write_visibility(const Track<double>& track, const FrameRate& rate);
/// Nothing if a value has no exact degrees; it has to be written in radians.
std::optional<nlohmann::ordered_json> write_degrees(const Track<double>& track, const FrameRate& rate);

/// An object with "keys" or "values". @param values  one for each time
nlohmann::ordered_json write_samples(const TimeSampling& sampling, const FrameRate& rate,
                                     std::vector<nlohmann::ordered_json> values);

nlohmann::ordered_json write_dvec3(const glm::dvec3& value);

// The list of transform operations of a node (operations.cpp).

/// Every operation is an object with one key. Keyed operations have the same times.
/// @throws InputError with the pointer of the faulty operation
OperationStack read_operations(const JsonRef& at, const FrameRate& rate);

/// @throws InputError if channels and operations do not match
nlohmann::ordered_json write_operations(const OperationStack& stack, const FrameRate& rate, const std::string& file,
                                        const std::string& place);

}  // namespace aleph
