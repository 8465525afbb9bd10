// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/nrrd_write.h"

#include <fmt/format.h>

#include <bit>
#include <vector>

#include "io/atomic_file.h"

namespace pellucid::io {

namespace {

/// Shortest decimal text that reads back to the same doubles.
std::string vectorText(const glm::dvec4& v) {
    return fmt::format("({},{},{})", v.x, v.y, v.z);
}

std::string headerOf(const Volume& volume) {
    const Grid& grid = volume.grid();
    const bool several = volume.components() > 1;
    std::string type = name(volume.type());
    if (type == "float32") type = "float";
    if (type == "float64") type = "double";
    std::string header = fmt::format("NRRD0004\ntype: {}\ndimension: {}\nspace: left-posterior-superior\n",
                                     type, several ? 4 : 3);
    header += fmt::format("sizes: {}{} {} {}\n", several ? fmt::format("{} ", volume.components()) : "",
                          grid.size.x, grid.size.y, grid.size.z);
    header += fmt::format("space directions: {}{} {} {}\n", several ? "none " : "",
                          vectorText(grid.patientFromIndex[0]), vectorText(grid.patientFromIndex[1]),
                          vectorText(grid.patientFromIndex[2]));
    header += fmt::format("kinds: {}domain domain domain\n", several ? "vector " : "");
    header += fmt::format("space origin: {}\n", vectorText(grid.patientFromIndex[3]));
    header += fmt::format("endian: {}\n", std::endian::native == std::endian::little ? "little" : "big");
    if (!volume.mapping().unit.empty()) header += fmt::format("sample units: {}\n", volume.mapping().unit);
    return header + "encoding: raw\n\n";
}

}  // namespace

Result<void> writeNrrd(const std::filesystem::path& file, const Volume& volume) {
    if (volume.mapping().slope != 1.0 || volume.mapping().intercept != 0.0)
        return fail(ErrorCode::InvalidArgument,
                    "the volume has a slope or an intercept, which an NRRD cannot hold");
    const std::string header = headerOf(volume);
    const auto text = std::as_bytes(std::span(header));
    std::vector<std::byte> bytes(text.begin(), text.end());
    bytes.insert(bytes.end(), volume.bytes().begin(), volume.bytes().end());
    return writeFile(file, bytes);
}

}  // namespace pellucid::io
