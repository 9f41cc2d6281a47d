#pragma once
// Parts of `aleph compare`: its options, sequences of frames, the results as text, JSON and pictures.

#include <filesystem>
#include <string>
#include <vector>

#include "render/compare/compare_sequence.h"

namespace aleph {

struct CompareOptions {
    std::string first;       ///< a picture, or the pattern or folder of a sequence
    std::string second;      ///< the reference, of the same kind
    std::string threshold;   ///< maps of the reference, of the same kind; may be empty
    std::string seen;        ///< maps of the reference for visible differences, likewise
    std::string seen_out;    ///< file or pattern of the pictures of visible differences; may be empty
    std::string difference;  ///< file or pattern of the difference pictures; may be empty
    std::string junit;       ///< file of test results; may be empty
    std::string cuts;        ///< list of frames that begin a new shot
    CompareSettings settings;
    bool json = false, quiet = false;
};

/// Returns whether an argument names a sequence: a folder, or a name with a place for the frame number. An existing
/// file is a picture, whatever its name.
bool names_sequence(const std::string& argument);

/// Compares two pictures, or pairs the frames of two sequences by number, and prints the result.
/// @return the exit code
/// @throws InputError naming frames without partner or maps; a frame that is unreadable or of another shape
int compare_frames(const CompareOptions& options);

/// Prints the result of two pictures: a table, or JSON.
void print_comparison(const CompareOptions& options, const FrameComparison& comparison);

/// One line per frame, and a summary; or JSON.
void print_sequence(const CompareOptions& options, const std::vector<FrameComparison>& frames,
                    const SequenceSummary& summary);

/// The options whose limits are exceeded, such as "--max-rms"; the share's has a row of its own.
std::string exceeded_options(const CompareResult& result);

/// Writes seen, flicker and lasting in just visible differences: as the channels seen.Y, flicker.Y and lasting.Y if the
/// path ends in .exr, else as three panels with a colour scale from .1 to 10.
/// @throws OutputError naming the file
void write_seen(const std::filesystem::path& path, const VisibleMaps& maps);

}  // namespace aleph
