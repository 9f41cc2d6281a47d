#pragma once
// A locale whose decimal point is a comma (DT-09, tests/HAZARDS.md), compiled for the test where the system has
// none.

#include <stdlib.h>

#include <clocale>
#include <string>

#include "tests/support/scratch_folder.h"

namespace aleph {

/// Sets de_DE.UTF-8 for a scope, also in the environment of programs that are started in it.
class GermanLocale {
  public:
    GermanLocale() {
        const std::string compile =
            "localedef -i de_DE -f UTF-8 '" + (folder_ / "de_DE.UTF-8").string() + "' >/dev/null 2>&1";
        if (!::setlocale(LC_ALL, "de_DE.UTF-8")) {
            [[maybe_unused]] const int code = ::system(compile.c_str());
            ::setenv("LOCPATH", folder_.path().c_str(), 1);
        }
        ::setenv("LC_ALL", "de_DE.UTF-8", 1);
        available_ = ::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr && *::localeconv()->decimal_point == ',';
    }
    ~GermanLocale() {
        ::unsetenv("LOCPATH");
        ::unsetenv("LC_ALL");
        ::setlocale(LC_ALL, "C");
    }
    GermanLocale(const GermanLocale&) = delete;
    GermanLocale& operator=(const GermanLocale&) = delete;

    bool available() const { return available_; }

  private:
    ScratchFolder folder_;
    bool available_ = false;
};

}  // namespace aleph
