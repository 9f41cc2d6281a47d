#include "render/cli/compare/seen_file.h"

#include "engine/image/image_file.h"
#include "render/output/sheet.h"

namespace aleph {

void write_seen(const std::filesystem::path& path, const VisibleMaps& maps) {
    if (path.extension() == ".exr") {
        write_exr(path, {{{"seen.Y", maps.seen}, {"flicker.Y", maps.flicker}, {"lasting.Y", maps.lasting}}, {}});
        return;
    }
    const MapRange range{0.1, 10.0, true};
    write_sheet(path,
                {map_panel("seen, visible differences", maps.seen, range), map_panel("flicker", maps.flicker, range),
                 map_panel("lasting", maps.lasting, range)},
                3, maps.seen.width);
}

}  // namespace aleph
