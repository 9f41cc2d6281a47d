// The program `aleph`.

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <iostream>

#include "render/cli/commands.h"

namespace {

/// Opens what was closed of standard input, output and errors. A file of ours would else get its number, and messages
/// would end up in it.
void open_standard_files() {
    int file = 0;
    while (file >= 0 && file <= STDERR_FILENO) file = ::open("/dev/null", O_RDWR);
    if (file > STDERR_FILENO) ::close(file);
}

}  // namespace

int main(int argc, char** argv) {
    open_standard_files();
    // A write beyond the file size limit, or to a program that has ended, then fails with an error and does not end
    // this one. Programs that this one starts have the signals as always.
    std::signal(SIGXFSZ, [](int) {});
    std::signal(SIGPIPE, [](int) {});
    return aleph::run_aleph(argc, argv, std::cerr);
}
