#pragma once
// The records of lighting keyframes in a file, so that a later run of the same scene, settings and program need not
// compute them again.
//
// Content (seal), in the byte order of the machine: the size of the fingerprint (uint64) and its text; the size of a
// record (uint64); the number of keyframes (uint64); per keyframe its frame (int64) and two lists (KeyframeRecords),
// each the number of its records (uint64) and the records.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "render/settings/fingerprint.h"
#include "render/time/keyframe_light.h"

namespace aleph {

/// The records of each lighting keyframe, by its frame.
using ShotRecords = std::map<std::int64_t, KeyframeRecords>;

/// Everything that records depend on.
/// @param scene   with its cages at the levels that are rendered
Fingerprint make_cache_fingerprint(const Scene& scene, const RenderSettings& settings,
                                   const std::vector<CameraShot>& shots);

/// Replaces the file, whole or not at all.
/// @throws OutputError
void write_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint, const ShotRecords& keyframes);

/// @return nothing if there is no such file
/// @throws InputError naming the file: it cannot be read, is no cache file, is damaged or not complete, or is of
/// another build, scene or setting
ShotRecords read_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint);

/// The light of lighting keyframes kept for other runs: in one file that is written at the end, or in a folder with a
/// file for each keyframe, which several processes fill and read at one time.
class LightStore {
  public:
    /// Reads the file, if there is one. A folder is a path that ends in '/' or exists as one; it is made.
    /// @throws InputError as read_cache_file; OutputError if the folder cannot be made
    LightStore(std::filesystem::path path, Fingerprint fingerprint);

    /// The records of a keyframe, if they are kept. The name of a folder's file has the fingerprint: files of other
    /// scenes, settings and programs may lie beside it.
    /// @throws InputError as read_cache_file; OutputError if it is not in the file, and the file cannot be written
    std::optional<KeyframeRecords> find(std::int64_t keyframe) const;

    /// Keeps the records of a keyframe: in a folder at once, where that can be written.
    void keep(std::int64_t keyframe, const KeyframeRecords& records);

    /// Writes what is not written yet.
    /// @throws OutputError
    void save();

  private:
    std::filesystem::path file_of(std::int64_t keyframe) const;

    const std::filesystem::path path_;
    const Fingerprint fingerprint_;
    const bool is_folder_;
    ShotRecords records_;   ///< of the file; of a folder those that are not written
    bool changed_ = false;  ///< since the file was read or written
};

}  // namespace aleph
