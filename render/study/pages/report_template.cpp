// The bundled pages as part of the program: the assembler includes the files.

#include "render/study/pages/pages.h"

asm(".section .rodata\n"
    ".global aleph_report_begin\n"
    ".global aleph_report_end\n"
    ".global aleph_viewer_begin\n"
    ".global aleph_viewer_end\n"
    "aleph_report_begin:\n"
    ".incbin \"" ALEPH_PAGES
    "/report-template.html\"\n"
    "aleph_report_end:\n"
    ".byte 0\n"
    "aleph_viewer_begin:\n"
    ".incbin \"" ALEPH_PAGES
    "/viewer-template.html\"\n"
    "aleph_viewer_end:\n"
    ".byte 0\n"
    ".text\n");

extern "C" const char aleph_report_begin[], aleph_report_end[], aleph_viewer_begin[], aleph_viewer_end[];

namespace aleph {

std::string_view report_template() {
    return {aleph_report_begin, static_cast<std::size_t>(aleph_report_end - aleph_report_begin)};
}

std::string_view viewer_template() {
    return {aleph_viewer_begin, static_cast<std::size_t>(aleph_viewer_end - aleph_viewer_begin)};
}

}  // namespace aleph
