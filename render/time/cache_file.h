#pragma once
// The records of lighting keyframes in a file, so that a later run of the same scene, settings and program need not
// compute them again.
//
// Layout, in the byte order of the machine: 8 bytes of magic; the size of the fingerprint (uint64) and its text; the
// size of a record (uint64); the number of keyframes (uint64); per keyframe its frame (int64) and two
// lists (KeyframeRecords), each the number of its records (uint64) and the records; SHA-1 of all bytes before, 40
// hexadecimal digits.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/settings/fingerprint.h"
#include "render/time/keyframe_light.h"

namespace aleph {

/// The records of each lighting keyframe, by its frame.
using ShotRecords = std::map<std::int64_t, KeyframeRecords>;

/// Everything that records depend on.
/// @param scene   with its cages at the levels that are rendered
/// @param shots   list_camera_shots
Fingerprint make_cache_fingerprint(const Scene& scene, const RenderSettings& settings,
                                   const std::vector<CameraShot>& shots);

/// Replaces the file, whole or not at all.
/// @throws OutputError
void write_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint, const ShotRecords& keyframes);

/// @return nothing if there is no such file
/// @throws InputError naming the file: it cannot be read, is no cache file, is damaged or not complete, or is of
/// another build, scene or setting
ShotRecords read_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint);

}  // namespace aleph
