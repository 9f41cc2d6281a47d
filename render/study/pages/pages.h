#pragma once
// The results of a study for people: as HTML files that open from disk, and as a picture.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "render/study/run_study.h"
#include "render/study/study_files.h"

namespace aleph {

/// The bundled page with places for data; empty where the program was built without it (render/report/README.md).
std::string_view report_template();

/// A report holds at most about so many bytes: what does not fit is left out, the least needed maps of the variants
/// that others beat first.
inline constexpr std::size_t most_report_bytes = 24'000'000;

/// The page of a study.
/// @param page  report_template()
/// @param json  study_json
/// @throws InputError if a picture of a run cannot be read; std::logic_error if the page has no places for data
std::string make_report(std::string_view page, nlohmann::ordered_json json, const StudyResults& results,
                        std::size_t most_bytes = most_report_bytes);

/// How the maps of a report are shown, and the steps from a pixel's motion to its error: what the page lists.
nlohmann::ordered_json report_maps();
nlohmann::ordered_json report_walk(const StudyResults& results);

enum class LayerType {
    f16,  ///< half precision: what is looked at; above 65504 it is that
    f32,  ///< what is read
};

/// The values of a layer as base64 of a zlib stream: little endian, channel after channel, row 0 on top; the bytes are
/// sorted by significance, the least first, which makes them a quarter to a half shorter.
/// @param channels  of one size
std::string encode_layer(const std::vector<const Image<float>*>& channels, LayerType type);

/// The layers of a page, up to a size.
class ReportLayers {
  public:
    /// @param most_bytes  of all layers together
    explicit ReportLayers(std::size_t most_bytes) : left_(most_bytes) {}

    /// Adds a layer if it fits. @return what the page's data say of it, or null
    nlohmann::ordered_json add(const std::vector<const Image<float>*>& channels, LayerType type);

    std::size_t left_out() const { return left_out_; }
    /// The elements of the page, in the order in which they were added.
    const std::string& elements() const { return elements_; }

  private:
    std::size_t left_, count_ = 0, left_out_ = 0;
    std::string elements_;
};

/// A script element of JSON, which a "</script>" in a text must not end.
std::string script_json(const char* id, const nlohmann::ordered_json& json);

/// Puts a text in the place of a comment of the page.
void insert(std::string& page, std::string_view place, const std::string& text);

/// The bundled page with a place for data; empty where the program was built without it.
std::string_view viewer_template();

/// The viewer test of a study as one HTML file: do people see what the models of vision say? (Yee 2000, 7.1, asked a
/// panel of viewers.) Each trial shows the reference and a variant, one after the other, and asks which had the errors.
/// The page has the frames of the study's scenes, in their order, as 8-bit sRGB pictures, with the viewing conditions
/// of each scene. The level of a variant is the factor of its noise, or its value of the first sweep with numbers;
/// without one there is none, and no function is fitted.
/// @param page  viewer_template()
/// @throws InputError if a picture of a run cannot be read
std::string make_viewer_test(std::string_view page, const PreparedStudy& prepared, const StudyResults& results,
                             const StudyContext& context);

/// @throws InputError (--errors) if no variant has this name
void check_variant_name(const PreparedStudy& prepared, const std::string& variant);

/// A row per frame: for each variant its picture, and for each viewer the error of its luminance in visible thresholds,
/// .1 to 10.
/// @param path      PNG, or JPEG if it ends in .jpg
/// @param variants  names of variants (check_variant_name)
/// @throws OutputError
void write_error_sheet(const std::filesystem::path& path, const PreparedStudy& prepared, const StudyResults& results,
                       const std::vector<std::string>& variants);

}  // namespace aleph
