// OpenEXR from and to memory.

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/image/codec.h"
#include "engine/image/exr_stream.h"

namespace aleph {

namespace {

/// OpenEXR has one pool of threads per process. It only grows: another caller may be using its threads.
/// @return how many of the threads asked for it is to use; 0: none of the pool's
int grow_thread_pool(int threads) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    const int most = static_cast<int>(std::thread::hardware_concurrency());
    const int wanted = std::min(threads, most);
    try {
        if (wanted > 1 && Imf::globalThreadCount() < wanted) Imf::setGlobalThreadCount(wanted);
    } catch (const std::exception&) {  // the system has no more threads: with those that there are
    }
    return wanted > 1 ? std::min(wanted, Imf::globalThreadCount()) : 0;
}

/// Checks faults that OpenEXR would find late or write into the file.
void check_channels(const ChannelImage& image) {
    if (image.channels.empty()) throw InputError("", "", "there is no channel to write");
    const Image<float>& first = image.channels.front().values;
    check_size(first.width, first.height, "");
    std::set<std::string> names;
    for (const Channel& channel : image.channels) {
        const std::string place = fmt::format("channel '{}'", printable(channel.name));
        if (channel.name.empty() || channel.name.size() > 255 || channel.name.find('\0') != std::string::npos) {
            throw InputError("", place, "the name must have 1 to 255 bytes, none of them 0");
        }
        if (!names.insert(channel.name).second) throw InputError("", place, "is there twice");
        if (!same_size(channel.values, first)) {
            throw InputError("", place,
                             fmt::format("is {}x{}, the first channel is {}x{}", channel.values.width,
                                         channel.values.height, first.width, first.height));
        }
    }
}

/// Attributes about the storage of pixels, which are not metadata.
constexpr std::array<std::string_view, 17> structural_names = {
    {"channels", "chromaticities", "chunkCount", "compression", "dataWindow", "displayWindow", "lineOrder",
     "maxSamplesPerPixel", "name", "pixelAspectRatio", "preview", "screenWindowCenter", "screenWindowWidth", "tiles",
     "type", "version", "view"}};

bool is_structural(std::string_view name) {
    return std::ranges::find(structural_names, name) != structural_names.end();
}

void insert_attribute(Imf::Header& header, const std::string& name, const MetadataValue& value) {
    if (name.empty() || name.size() > 255 || is_structural(name)) {
        throw InputError("", fmt::format("metadata '{}'", printable(name)), "this name is not free");
    }
    // The standard attribute is a 32-bit float; readers ignore another type.
    if (name == "whiteLuminance" && std::holds_alternative<double>(value)) {
        Imf::addWhiteLuminance(header, static_cast<float>(std::get<double>(value)));
    } else if (const auto* text = std::get_if<std::string>(&value)) {
        header.insert(name, Imf::StringAttribute(*text));
    } else if (const auto* number = std::get_if<double>(&value)) {
        header.insert(name, Imf::DoubleAttribute(*number));
    } else if (const auto* matrix = std::get_if<Matrix44f>(&value)) {
        Imath::M44f m;
        std::ranges::copy(*matrix, m.getValue());
        header.insert(name, Imf::M44fAttribute(m));
    } else {
        const auto& [numerator, denominator] = std::get<std::array<int, 2>>(value);
        if (denominator <= 0) throw InputError("", fmt::format("metadata '{}'", name), "needs a denominator above 0");
        header.insert(name, Imf::RationalAttribute(Imf::Rational(numerator, static_cast<unsigned>(denominator))));
    }
}

std::map<std::string, MetadataValue> read_attributes(const Imf::Header& header) {
    std::map<std::string, MetadataValue> metadata;
    for (auto it = header.begin(); it != header.end(); ++it) {
        if (is_structural(it.name())) continue;
        const Imf::Attribute& attribute = it.attribute();
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
            metadata[it.name()] = text->value();
        } else if (const auto* real = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) {
            metadata[it.name()] = real->value();
        } else if (const auto* single = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
            metadata[it.name()] = static_cast<double>(single->value());
        } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
            metadata[it.name()] = static_cast<double>(integer->value());
        } else if (const auto* m = dynamic_cast<const Imf::M44fAttribute*>(&attribute)) {
            Matrix44f matrix;
            std::copy_n(m->value().getValue(), matrix.size(), matrix.begin());
            metadata[it.name()] = matrix;
        } else if (const auto* ratio = dynamic_cast<const Imf::RationalAttribute*>(&attribute)) {
            if (ratio->value().d <= static_cast<unsigned>(std::numeric_limits<int>::max())) {
                metadata[it.name()] = std::array{ratio->value().n, static_cast<int>(ratio->value().d)};
            }
        }
    }
    return metadata;
}

/// Refuses multi-part and deep files by the flags of the version field (OpenEXR file layout), before decoding.
void refuse_unsupported_kinds(ByteView bytes, const std::string& name) {
    if (bytes.size() < 8) throw InputError(name, "", "the file is cut");
    const auto flags = static_cast<int>(bytes[4] | bytes[5] << 8 | bytes[6] << 16 | bytes[7] << 24);
    if (Imf::isMultiPart(flags)) throw InputError(name, "", "multi-part EXR files are not read; write one part a file");
    if (Imf::isNonImage(flags)) throw InputError(name, "", "deep EXR files are not read; flatten it first");
}

Imf::Slice make_slice(const Image<float>& image, const Imath::Box2i& window) {
    auto* values = const_cast<float*>(image.pixels.data());  // a Slice is for reading and writing
    return Imf::Slice::Make(Imf::FLOAT, values, window, sizeof(float), sizeof(float) * image.width);
}

/// The whole picture of a file, unless its pixels are all of it. OpenEXR refuses corners beyond 2^30.
std::optional<PictureArea> find_whole(const Imf::Header& header) {
    const Imath::Box2i &whole = header.displayWindow(), &pixels = header.dataWindow();
    if (whole == pixels) return std::nullopt;
    const Imath::V2i place = whole.min - pixels.min, size = whole.size() + Imath::V2i(1);
    return PictureArea{place.x, place.y, size.x, size.y};
}

/// Reads the last row back: OpenEXR finishes a file in a destructor, which loses errors.
void verify(const std::string& bytes, const Image<float>& first, const Channel& last) {
    MemoryInput stream({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    Imf::InputFile file(stream, 0);
    const Imath::Box2i window = file.header().dataWindow();
    Image<float> row(first.width, 1);
    Imf::FrameBuffer pixels;
    pixels.insert(last.name, make_slice(row, {{window.min.x, window.max.y}, window.max}));
    file.setFrameBuffer(pixels);
    file.readPixels(window.max.y);
    if (!file.isComplete() ||
        std::memcmp(row.row(0), last.values.row(first.height - 1), row.size() * sizeof(float)) != 0) {
        throw std::runtime_error("the encoded picture does not read back");
    }
}

/// Turns other exceptions into InputErrors.
template <class Use>
auto with_input_errors(const std::string& name, const Use& use) {
    try {
        return use();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& e) {
        throw InputError(name, "", printable(e.what(), 400));
    }
}

}  // namespace

std::string encode_exr(const ChannelImage& image, int threads) {
    check_channels(image);
    const Image<float>& first = image.channels.front().values;
    return with_input_errors("", [&]() -> std::string {
        const PictureArea whole = image.whole.value_or(PictureArea{0, 0, first.width, first.height});
        const Imath::V2i place(-whole.x, -whole.y);
        const Imath::Box2i window(place, place + Imath::V2i(first.width - 1, first.height - 1));
        Imf::Header header(Imath::Box2i({0, 0}, {whole.width - 1, whole.height - 1}), window);
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec.709 with D65
        for (const auto& [name, value] : image.metadata) insert_attribute(header, name, value);
        Imf::FrameBuffer pixels;
        for (const Channel& channel : image.channels) {
            header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
            pixels.insert(channel.name, make_slice(channel.values, window));
        }
        Imf::StdOSStream stream;
        {
            Imf::OutputFile file(stream, header, grow_thread_pool(threads));
            file.setFrameBuffer(pixels);
            file.writePixels(first.height);
        }
        std::string bytes = stream.str();
        verify(bytes, first, image.channels.back());
        return bytes;
    });
}

std::optional<std::string> find_exr_text(const std::filesystem::path& path, const std::string& key) {
    return with_input_errors(printable(path.string(), 400), [&]() -> std::optional<std::string> {
        Imf::InputFile file(path.c_str(), 0);
        const auto* text = file.header().findTypedAttribute<Imf::StringAttribute>(key);
        const Imath::Box2i window = file.header().dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        check_size(width, std::int64_t{window.max.y} - window.min.y + 1, path.string());
        if (text == nullptr || !file.isComplete()) return std::nullopt;
        const auto channels = file.header().channels().begin();
        if (channels == file.header().channels().end()) return std::nullopt;
        Image<float> row(static_cast<int>(width), 1);
        Imf::FrameBuffer pixels;
        const Imath::Box2i last({window.min.x, window.max.y}, window.max);
        pixels.insert(channels.name(), make_slice(row, last));
        file.setFrameBuffer(pixels);
        file.readPixels(window.max.y);
        return text->value();
    });
}

ChannelImage decode_exr(ByteView bytes, const std::string& name) {
    refuse_unsupported_kinds(bytes, name);
    check_exr_header(bytes, name);
    return with_input_errors(name, [&]() -> ChannelImage {
        MemoryInput stream(bytes);
        Imf::InputFile file(stream, grow_thread_pool(thread_count()));
        const Imf::Header& header = file.header();
        const Imath::Box2i window = header.dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        check_size(width, height, name);

        ChannelImage image;
        for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
            if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
                throw InputError(name, fmt::format("channel '{}'", printable(it.name())),
                                 "is subsampled (luminance/chroma), which is not read");
            }
            image.channels.push_back({it.name(), {}});
        }
        if (image.channels.empty()) throw InputError(name, "", "the file has no channels");
        if (static_cast<std::uint64_t>(width * height) > 8 * max_pixels / image.channels.size()) {
            throw InputError(name, "",
                             fmt::format("{} channels of {}x{} are too many", image.channels.size(), width, height));
        }
        Imf::FrameBuffer pixels;
        for (Channel& channel : image.channels) {
            channel.values = Image<float>(static_cast<int>(width), static_cast<int>(height));
            pixels.insert(channel.name, make_slice(channel.values, window));
        }
        file.setFrameBuffer(pixels);
        file.readPixels(window.min.y, window.max.y);
        image.metadata = read_attributes(header);
        image.whole = find_whole(header);
        return image;
    });
}

}  // namespace aleph
