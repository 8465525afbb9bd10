// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pellucid::test {

enum class DicomEncoding { ExplicitLittle, ImplicitLittle, ExplicitBig };

/// A DICOM file as a table of elements, written byte by byte after PS3.5 and PS3.10 without any DICOM
/// library, so that tests of the reader do not share its errors.
class SyntheticFile {
public:
    /// Text values are padded to even length. `tag` is group << 16 | element.
    void setText(std::uint32_t tag, std::string_view vr, std::string text);
    void setShort(std::uint32_t tag, std::uint16_t value);
    void setSequence(std::uint32_t tag, std::string content);
    void setPixels(std::vector<std::uint8_t> littleEndian, int bytesPerPixel);
    void erase(std::uint32_t tag) { m_elements.erase(tag); }

    /// The whole file: preamble, meta information, data set.
    [[nodiscard]] std::string encoded(DicomEncoding encoding) const;
    void write(const std::filesystem::path& file,
               DicomEncoding encoding = DicomEncoding::ExplicitLittle) const;

private:
    struct Value {
        std::string vr;
        std::string bytes;  ///< Little endian.
        int wordBytes = 1;  ///< What is swapped for big endian.
    };
    std::map<std::uint32_t, Value> m_elements;
};

/// A CT series of known geometry and values.
struct SyntheticSeries {
    glm::ivec2 size{7, 5};  ///< Columns, rows.
    int slices = 4;
    glm::dvec3 rowDirection{1, 0, 0};
    glm::dvec3 columnDirection{0, 1, 0};
    glm::dvec2 spacingMm{0.75, 1.25};  ///< Between columns, between rows.
    glm::dvec3 originMm{-20, -30, 100};
    glm::dvec3 stepMm{0, 0, 2.5};  ///< From slice k to slice k + 1.
    int bitsAllocated = 16;
    int bitsStored = 12;
    int highBit = 11;
    bool isSigned = false;
    double slope = 1.0;
    double intercept = -1024.0;
    std::string seriesUid = "1.2.3.4.5";
    std::string description = "Synthetic";
    DicomEncoding encoding = DicomEncoding::ExplicitLittle;
    /// Stored value of a voxel.
    std::function<std::int64_t(int i, int j, int k)> value = [](int i, int j, int k) {
        return i + 10 * j + 100 * k;
    };
    /// The name of slice k; the default sorts against the order of the slices.
    std::function<std::string(int k)> fileName;
    /// Last change of a slice before it is written.
    std::function<void(SyntheticFile&, int k)> edit;
};

[[nodiscard]] SyntheticFile makeSlice(const SyntheticSeries& series, int k);
/// Writes all slices into `folder`, which is made; returns their paths by k.
std::vector<std::filesystem::path> writeSeries(const SyntheticSeries& series,
                                               const std::filesystem::path& folder);

/// Value of a decimal string (DS), exact to 16 characters.
[[nodiscard]] std::string decimalText(std::initializer_list<double> values);

/// A folder of its own in the system's temporary place, removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return m_path; }

private:
    std::filesystem::path m_path;
};

}  // namespace pellucid::test
