#include "render/cli/frame_file.h"

#include <fmt/format.h>

#include <system_error>

#include "engine/base/pixel_loops.h"
#include "engine/image/image_file.h"
#include "render/cli/support/output_path.h"
#include "render/output/frame_files.h"
#include "render/output/sheet.h"
#include "render/settings/fingerprint.h"
#include "render/settings/measure.h"

namespace aleph {

namespace {

ChannelImage with_texts(ChannelImage image, const PictureTexts& texts) {
    for (const auto& [key, text] : texts) image.metadata[key] = text;
    return image;
}

/// EXR: the channel Y. PNG: grey, its bytes in proportion to the values.
void write_importance(const std::filesystem::path& path, const FrameOutput& output, const PictureTexts& texts) {
    const Image<float> importance = make_importance(output.perception.aleph);
    if (output_format(path) == OutputFormat::exr) {
        ChannelImage file;
        file.channels.push_back({"Y", importance});
        file.whole = find_whole(output);
        write_exr(path, with_texts(std::move(file), texts));
        return;
    }
    write_png(path, map_pixels([](float value) { return Rgb(srgb_to_linear(value)); }, importance), texts);
}

/// "name.0020.partial.exr"
std::filesystem::path partial_file(const std::filesystem::path& file) {
    return file.parent_path() / fmt::format("{}.partial{}", file.stem().string(), file.extension().string());
}

}  // namespace

void write_frame(const std::filesystem::path& path, const FrameJob& job, FrameOutput& output, bool maps,
                 bool importance, const std::string& fingerprint) {
    StageClock clock;
    const PictureTexts texts{{fingerprint_key, fingerprint}};
    if (importance) {
        write_importance(path, output, texts);
    } else if (output_format(path) == OutputFormat::exr) {
        write_exr(path, with_texts(make_frame_image(output, maps, job.scene, job.settings, job.exposure), texts));
    } else if (output.shaded.color.empty()) {
        write_map_preview(path, output, texts);
    } else {
        write_png(path, output.shaded.color, texts);
    }
    StageSeconds& seconds = output.statistics.seconds;
    clock.add_to(seconds.write);
    seconds.total += seconds.write;
}

void remove_unfinished(const std::filesystem::path& file) {
    std::error_code ignored;
    if (read_picture_text(partial_file(file), fingerprint_key)) std::filesystem::remove(partial_file(file), ignored);
    std::filesystem::remove(checkpoint_file(file), ignored);
}

void write_partial(const std::filesystem::path& file, const Image<Rgb>& color, const std::optional<PictureArea>& window,
                   const std::string& fingerprint) {
    const std::filesystem::path partial = partial_file(file);
    const PictureTexts texts{{fingerprint_key, fingerprint}};
    const PictureArea area = window.value_or(PictureArea{0, 0, color.width, color.height});
    const Image<Rgb> shown = crop(color, area);
    if (output_format(file) == OutputFormat::png) return write_png(partial, shown, texts);
    ChannelImage image = with_texts(make_color_image(shown), texts);
    if (window) image.whole = PictureArea{-area.x, -area.y, color.width, color.height};
    write_exr(partial, image);
}

}  // namespace aleph
