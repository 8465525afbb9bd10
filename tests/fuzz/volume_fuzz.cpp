// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// One libFuzzer entry for every parser: the bytes become a file of the format's name, and the file is opened.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/scene_file.h"

namespace {

namespace fs = std::filesystem;

fs::path scratchFolder() {
    const fs::path folder = fs::temp_directory_path() / ("pellucid-fuzz-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fs::path folder = scratchFolder();
    fs::path file = folder / FUZZ_FILE;
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    // A sidecar is parsed when the file that it describes is opened.
    if (file.extension() == ".json") {
        file.replace_extension();
        std::ofstream(file, std::ios::binary) << "twenty-four bytes of it.";
    }
    pellucid::io::LoadOptions options;
    options.maxVoxelBytes = 64 << 20;
    const auto opened = pellucid::io::open({file}, options);
    // A refusal without a sentence is a finding too.
    if (!opened && opened.error().message.empty()) std::abort();
    return 0;
}
