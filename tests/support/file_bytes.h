// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Small files of every volume format, written byte by byte after the formats' descriptions and without the
// code under test, so that a reader's mistake is not repeated by its writer.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace pellucid::test {

/// A folder of its own, gone at the end.
class TempFolder {
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return m_path; }
    /// Writes a file there and returns its path.
    std::filesystem::path write(const std::string& name, const std::string& bytes) const;
    /// Names of what is in it, sorted.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    std::filesystem::path m_path;
};

[[nodiscard]] std::string readBytes(const std::filesystem::path& file);
[[nodiscard]] std::string gzipped(const std::string& bytes);
[[nodiscard]] std::string zlibbed(const std::string& bytes);

/// The bytes of values one after the other.
template <class T>
[[nodiscard]] std::string bytesOf(const std::vector<T>& values, bool bigEndian = false) {
    std::string result(values.size() * sizeof(T), '\0');
    std::memcpy(result.data(), values.data(), result.size());
    for (std::size_t at = 0; bigEndian && at < result.size(); at += sizeof(T)) {
        std::string item = result.substr(at, sizeof(T));
        for (std::size_t i = 0; i < sizeof(T); ++i) result[at + i] = item[sizeof(T) - 1 - i];
    }
    return result;
}

/// 0, 1, 2 ... count - 1, shifted so that some are negative where the type can.
template <class T>
[[nodiscard]] std::vector<T> ramp(std::size_t count) {
    std::vector<T> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = static_cast<T>(static_cast<int>(i) - (std::is_signed_v<T> ? 5 : 0));
    return values;
}

/// A NIfTI header as nifti1.h or nifti2.h lay it out; `file` adds the voxels.
struct NiftiFile {
    int version = 1;
    bool bigEndian = false;
    bool pair = false;
    std::array<std::int64_t, 8> dim{3, 4, 3, 2, 1, 1, 1, 1};
    std::array<double, 8> pixdim{1, 1, 1, 1, 1, 1, 1, 1};
    int datatype = 4;  // int16
    int bitpix = 16;
    int intent = 0;
    int units = 2;  // mm
    double slope = 1.0;
    double inter = 0.0;
    double calMin = 0.0;
    double calMax = 0.0;
    int qformCode = 0;
    int sformCode = 1;
    std::array<double, 6> quatern{0, 0, 0, 0, 0, 0};  ///< b c d, offset x y z
    std::array<double, 12> srow{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

    /// 352 or 544 bytes (348 or 540 and no extension for a pair).
    [[nodiscard]] std::string header() const;
    [[nodiscard]] std::string file(const std::string& voxels) const { return header() + voxels; }
};

}  // namespace pellucid::test
