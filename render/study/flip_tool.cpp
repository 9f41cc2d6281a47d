#include "render/study/flip_tool.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string>

#include "engine/image/image_file.h"
#include "render/study/other_program.h"

namespace aleph {

bool has_flip() {
    return find_program("flip").has_value();
}

std::optional<double> run_flip(const Image<Rgb>& test, const Image<Rgb>& reference) {
    if (!has_flip()) return std::nullopt;
    const TemporaryFolder folder;
    write_png(folder.path() / "test.png", test);
    write_png(folder.path() / "reference.png", reference);
    const ProgramOutput output =
        run_program_in(folder.path(), {"flip", "--reference", "reference.png", "--test", "test.png"}, "");
    const std::size_t at = output.text.find("Mean:");
    if (output.code != 0 || at == std::string::npos) return std::nullopt;
    const std::size_t digits = output.text.find_first_of("0123456789", at);
    double mean = 0.0;
    const char* end = output.text.data() + output.text.size();
    if (digits == std::string::npos || std::from_chars(output.text.data() + digits, end, mean).ec != std::errc())
        return std::nullopt;
    return mean;
}

}  // namespace aleph
