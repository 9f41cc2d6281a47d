#pragma once
// The light of lighting keyframes kept for other runs: in one file that is written at the end, or in a folder with a
// file for each keyframe, which several processes fill and read at one time.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "render/time/cache_file.h"

namespace aleph {

class LightStore {
  public:
    /// Reads the file, if there is one. A folder is a path that ends in '/' or exists as one; it is made.
    /// @throws InputError as read_cache_file; OutputError if the folder cannot be made
    LightStore(std::filesystem::path path, Fingerprint fingerprint);

    /// The records of a keyframe, if they are kept. The name of a folder's file has the fingerprint: files of other
    /// scenes, settings and programs may lie beside it.
    /// @throws InputError as read_cache_file
    std::optional<KeyframeRecords> find(std::int64_t keyframe) const;

    /// Keeps the records of a keyframe: in a folder at once.
    /// @throws OutputError
    void keep(std::int64_t keyframe, const KeyframeRecords& records);

    /// Writes the file, if there is anything to add to it.
    /// @throws OutputError
    void save();

  private:
    std::filesystem::path file_of(std::int64_t keyframe) const;

    const std::filesystem::path path_;
    const Fingerprint fingerprint_;
    const bool is_folder_;
    ShotRecords records_;   ///< of the file
    bool changed_ = false;  ///< since the file was read or written
};

}  // namespace aleph
