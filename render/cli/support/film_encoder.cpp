#include "render/cli/support/film_encoder.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/image/image_file.h"
#include "render/cli/support/film_program.h"
#include "render/settings/fingerprint.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

constexpr std::size_t errors_shown = 600;  // bytes

/// Without the prefix a name with a colon would be a protocol, and one with a minus an option.
std::string file_word(const fs::path& file) {
    return "file:" + file.string();
}

/// How PNG files come in: one after the other, so that neither numbers nor names matter.
Words input_words(const FilmFrames& frames) {
    return OIIO::Strutil::splits(
        fmt::format("-hide_banner -loglevel error -nostdin -y -f image2pipe -c:v png -framerate {}/{} -i pipe:0",
                    frames.rate.numerator, frames.rate.denominator));
}

Words joined(const std::vector<Words>& parts) {
    Words words;
    for (const Words& part : parts) words.insert(words.end(), part.begin(), part.end());
    return words;
}

/// sRGB to YCbCr of BT.709, 16 to 235, with an even size.
std::string filters_420(const PictureSize& size) {
    const int right = size.width % 2, below = size.height % 2;
    std::string filters;
    if (right + below > 0) {
        filters = fmt::format("pad={}:{},fillborders=right={}:bottom={}:mode=smear,", size.width + right,
                              size.height + below, right, below);
    }
    return filters +
           "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_inp+full_chroma_int,format="
           "yuv420p,setparams=range=tv:colorspace=bt709:color_primaries=bt709:color_trc=bt709";
}

/// Compression without visible loss.
Words codec_words(const std::string& ending) {
    if (ending == ".webm") return OIIO::Strutil::splits("-c:v libvpx-vp9 -crf 20 -b:v 0 -cpu-used 2 -row-mt 1 -f webm");
    return OIIO::Strutil::splits("-c:v libx264 -crf 16 -movflags +faststart -f " + ending.substr(1));
}

/// @param share  of the whole work that this is, after what was done before
struct Pass {
    double before = 0.0, share = 1.0;
};

void run_pass(const fs::path& ffmpeg, const Words& words, const FilmFrames& frames, const Pass& pass,
              const std::function<void(double done)>& check) {
    std::size_t given = 0;
    const auto next = [&] {
        if (given == frames.files.size()) return Bytes();
        const fs::path& file = frames.files[given++];
        return read_regular_file(file, file.string(), "");
    };
    const ProgramEnd end = run_fed(ffmpeg, words, next, [&] {
        check(pass.before + pass.share * static_cast<double>(given) / static_cast<double>(frames.files.size()));
    });
    if (end.code == 0 && end.took_all) return;
    const std::string how = end.code < 0    ? "was ended by a signal"
                            : end.code == 0 ? "ended before it had read all frames"
                                            : fmt::format("failed with exit code {}", end.code);
    const std::size_t last = end.errors.find_last_not_of(" \t\r\n");
    throw OutputError(
        printable(ffmpeg.string(), 400),
        how + (last == std::string::npos ? "" : ": " + printable(end.errors.substr(0, last + 1), errors_shown)));
}

std::string mark_text(const std::string& ending, const std::string& fingerprint) {
    const std::string text = fmt::format("{}={}", fingerprint_key, fingerprint);
    const char size = static_cast<char>(text.size());  // below 127
    if (ending == ".gif") return std::string("\x21\xfe") + size + text + std::string("\0;", 2);
    if (ending == ".webm") return std::string("\xec") + static_cast<char>(0x80 | size) + text;
    return std::string("\0\0\0", 3) + static_cast<char>(size + 8) + "free" + text;
}

}  // namespace

PictureSize read_picture_size(const fs::path& file) {
    const ChannelImage picture = read_image(file);
    const Image<float>& first = picture.channels.front().values;
    return {first.width, first.height};
}

bool is_padded(const std::string& ending, const PictureSize& size) {
    return ending != ".gif" && (size.width % 2 != 0 || size.height % 2 != 0);
}

void encode_film(const fs::path& ffmpeg, const fs::path& film, const FilmFrames& frames,
                 const std::function<void(double done)>& check) {
    const Words input = input_words(frames);
    if (frames.ending == ".gif") {
        // Two passes: in one, ffmpeg would keep all frames in memory until it knows the palette.
        const std::string palette = file_word(film) + ".palette";
        const Words make = OIIO::Strutil::splits("-vf palettegen=reserve_transparent=0 -f image2pipe -c:v png");
        run_pass(ffmpeg, joined({input, make, {palette}}), frames, {0.0, 0.5}, check);
        const Words use = OIIO::Strutil::splits("-lavfi [0:v][1:v]paletteuse=dither=sierra2_4a -f gif");
        run_pass(ffmpeg, joined({input, {"-f", "png_pipe", "-i", palette}, use, {file_word(film)}}), frames, {0.5, 0.5},
                 check);
    } else {
        const Words filters{"-vf", filters_420(read_picture_size(frames.files.front()))};
        const Words threads{"-threads", std::to_string(frames.threads)};
        run_pass(ffmpeg, joined({input, filters, threads, codec_words(frames.ending), {file_word(film)}}), frames, {},
                 check);
    }
    std::error_code error;
    if (fs::file_size(film, error) == 0 || error) throw OutputError(printable(ffmpeg.string(), 400), "wrote no film");
}

void mark_film(const fs::path& film, const std::string& ending, const std::string& fingerprint) {
    if (ending == ".gif") fs::resize_file(film, fs::file_size(film) - 1);  // the mark has the last byte again
    std::ofstream file(film, std::ios::binary | std::ios::app);
    const std::string mark = mark_text(ending, fingerprint);
    file.write(mark.data(), static_cast<std::streamsize>(mark.size()));
    if (!file.flush()) throw OutputError(printable(film.string(), 4096), "cannot write");
}

bool has_mark(const fs::path& film, const std::string& ending, const std::string& fingerprint) {
    const std::string mark = mark_text(ending, fingerprint);
    std::ifstream file(film, std::ios::binary);
    std::string end(mark.size(), '\0');
    file.seekg(-static_cast<std::streamoff>(mark.size()), std::ios::end);
    file.read(end.data(), static_cast<std::streamsize>(end.size()));
    return file && end == mark;
}

}  // namespace aleph
