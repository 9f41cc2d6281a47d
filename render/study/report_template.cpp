// The bundled page as part of the program: the assembler includes the file.

#include "render/study/report_page.h"

asm(".section .rodata\n"
    ".global aleph_report_begin\n"
    ".global aleph_report_end\n"
    "aleph_report_begin:\n"
    ".incbin \"" ALEPH_REPORT_TEMPLATE
    "\"\n"
    "aleph_report_end:\n"
    ".byte 0\n"
    ".text\n");

extern "C" const char aleph_report_begin[], aleph_report_end[];

namespace aleph {

std::string_view report_template() {
    return {aleph_report_begin, static_cast<std::size_t>(aleph_report_end - aleph_report_begin)};
}

}  // namespace aleph
