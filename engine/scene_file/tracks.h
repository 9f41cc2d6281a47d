#pragma once
// Values over time in scene files: constants, keys, uniform and cyclic samples; and back to JSON, bit for bit.

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/json/json_ref.h"
#include "engine/scene_file/fields.h"

namespace aleph {

// The document has passed the schema, so types and lengths are right. All of these throw InputError with the pointer
// of the value that breaks a rule: limits (of values, not of tangents), ascending times, what goes together.
Track<double> read_number(const JsonRef& at, const FrameRate& rate, const ValueRange& range);
Track<glm::dvec3> read_vector(const JsonRef& at, const FrameRate& rate, const ValueRange& range);
Track<glm::dvec3> read_scale(const JsonRef& at, const FrameRate& rate);
Track<glm::dquat> read_quaternion(const JsonRef& at, const FrameRate& rate);
Track<glm::dmat4> read_matrix(const JsonRef& at, const FrameRate& rate);
/// false, true and "always" as 0, 1 and 2; step.
Track<double> read_visibility(const JsonRef& at, const FrameRate& rate);
/// Degrees in the file, radians in the track. @param range  degrees
Track<double> read_degrees(const JsonRef& at, const FrameRate& rate, const ValueRange& range);

/// Values of any kind over time: calls visit at each value of "keys" or "values", and gives their times.
TimeSampling read_samples(const JsonRef& at, const FrameRate& rate, const std::function<void(const JsonRef&)>& visit);

glm::dvec3 read_dvec3(const JsonRef& at);
glm::dvec2 read_dvec2(const JsonRef& at);

/// Degrees to radians as the reader does it.
double to_radians(double degrees);
/// The shortest degrees that to_radians turns into exactly these radians; nothing where no double does.
std::optional<double> exact_degrees(double radians);

// Times are written in frames where all of them are whole frames, else in seconds.
// The track is valid (track.h).
nlohmann::ordered_json write_number(const Track<double>& track, const FrameRate& rate);
nlohmann::ordered_json write_vector(const Track<glm::dvec3>& track, const FrameRate& rate);
nlohmann::ordered_json write_scale(const Track<glm::dvec3>& track, const FrameRate& rate);
nlohmann::ordered_json write_quaternion(const Track<glm::dquat>& track, const FrameRate& rate);
nlohmann::ordered_json write_matrix(const Track<glm::dmat4>& track, const FrameRate& rate);
nlohmann::ordered_json write_visibility(const Track<double>& track, const FrameRate& rate);
/// Nothing where a value has no exact degrees: then it has to be written in radians.
std::optional<nlohmann::ordered_json> write_degrees(const Track<double>& track, const FrameRate& rate);

/// An object with "keys" or "values", one each of the sampling's.
nlohmann::ordered_json write_samples(const TimeSampling& sampling, const FrameRate& rate,
                                     std::vector<nlohmann::ordered_json> values);

nlohmann::ordered_json write_dvec3(const glm::dvec3& value);

}  // namespace aleph
