// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/picture.h"
#include "app/cli/resources.h"

namespace pellucid::app {

namespace fs = std::filesystem;

namespace {

struct OpenArguments {
    std::vector<std::string> paths;
    bool sample = false;
};

bool hasDisplay() {
    const auto isSet = [](const char* variable) {
        const char* value = std::getenv(variable);
        return value != nullptr && *value != '\0';
    };
    return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY");
}

/// "a/head.nii.gz" to "pellucid-head.png", a folder "ct-head/" to "pellucid-ct-head.png": named after the
/// input, and unlikely to be a file somebody already has.
fs::path pictureNameFor(const fs::path& input) {
    const fs::path whole = fs::absolute(input).lexically_normal();
    const fs::path named = whole.has_filename() ? whole : whole.parent_path();
    std::error_code ignored;
    std::string stem = named.filename().string();
    if (!fs::is_directory(named, ignored)) stem = stem.substr(0, stem.find('.', 1));
    return fs::path("pellucid-" + stem + ".png");
}

int drawInstead(const std::vector<fs::path>& paths) {
    catchInterrupt();
    PictureJob job;
    for (const fs::path& path : paths) job.input.paths.push_back(path.string());
    job.outputs = {fs::absolute(pictureNameFor(paths.front()))};
    fmt::print(
        stderr,
        "pellucid: there is no display (DISPLAY and WAYLAND_DISPLAY are not set), drawing to a picture\n");
    return makePicture(job);
}

int run(const OpenArguments& arguments, const OpenDesktop& openDesktop) {
    std::vector<fs::path> paths(arguments.paths.begin(), arguments.paths.end());
    if (arguments.sample) {
        const Result<fs::path> sample = sampleScene();
        if (!sample) return report(sample.error());
        paths.push_back(*sample);
    }
    if (hasDisplay()) return openDesktop(paths);
    if (paths.empty()) {
        return reportUsage(
            "there is no display to open a window on, and no scan was named to draw to a picture", "");
    }
    return drawInstead(paths);
}

}  // namespace

Command addOpenCommand(CLI::App& program, const OpenDesktop& openDesktop) {
    const auto arguments = std::make_shared<OpenArguments>();
    program.add_option("path", arguments->paths, "A scene or a scan to open in the desktop")
        ->type_name("PATH");
    program.add_flag("--sample", arguments->sample, "Opens the sample scan that comes with the program");
    return {&program, [arguments, openDesktop] { return run(*arguments, openDesktop); }};
}

}  // namespace pellucid::app
