#pragma once
// The records of lighting keyframes in a file, so that a later run of the same scene, settings and program need not
// compute them again.
//
// Layout, in the byte order of the machine: 8 bytes of magic; the size of the fingerprint (uint64) and its text; the
// size of a record (uint64); the number of keyframes (uint64); per keyframe its frame (int64), the number of its
// records (uint64) and the records; SHA-1 of all bytes before, 40 hexadecimal digits.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/pose/pose.h"
#include "render/cache/irradiance_cache.h"
#include "render/settings/settings.h"

namespace aleph {

/// The records of each lighting keyframe, by its frame.
using KeyframeRecords = std::map<std::int64_t, std::vector<IrradianceRecord>>;

/// Everything that records depend on.
struct CacheFingerprint {
    std::string build;    ///< version and SHA-1 of the program file
    std::string scene;    ///< hash_scene, and the cameras
    SettingMap settings;  ///< those that count
};

/// @param scene   with its cages at the levels that are rendered
/// @param shots   list_camera_shots
CacheFingerprint make_cache_fingerprint(const Scene& scene, const RenderSettings& settings,
                                        const std::vector<CameraShot>& shots);

/// Replaces the file, whole or not at all.
/// @throws OutputError
void write_cache_file(const std::filesystem::path& path, const CacheFingerprint& fingerprint,
                      const KeyframeRecords& keyframes);

/// @return nothing if there is no such file
/// @throws InputError naming the file: it cannot be read, is no cache file, is damaged or not complete, or is of
/// another build, scene or setting
KeyframeRecords read_cache_file(const std::filesystem::path& path, const CacheFingerprint& fingerprint);

}  // namespace aleph
