// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "io/dicom_series.h"
#include "tests/support/corpus.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

std::vector<char> unpacked(const fs::path& file) {
    std::vector<char> bytes;
    gzFile stream = gzopen(file.c_str(), "rb");
    if (stream == nullptr) return bytes;
    std::vector<char> chunk(1 << 16);
    for (int got = 0; (got = gzread(stream, chunk.data(), static_cast<unsigned>(chunk.size()))) > 0;) {
        bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + got);
    }
    gzclose(stream);
    return bytes;
}

/// NIfTI-1 with an sform, read by itself so that truth does not come through the code under test.
struct Truth {
    std::vector<char> bytes;
    glm::ivec3 size{0};
    glm::dmat4 patientFromIndex{1.0};  ///< LPS.

    template <class T>
    [[nodiscard]] T at(std::size_t offset) const {
        T value;
        std::memcpy(&value, bytes.data() + offset, sizeof(T));
        return value;
    }
    explicit Truth(const fs::path& file) : bytes(unpacked(file)) {
        size = {at<std::int16_t>(42), at<std::int16_t>(44), at<std::int16_t>(46)};
        for (int row = 0; row < 3; ++row) {
            const double sign = row < 2 ? -1.0 : 1.0;  // RAS to LPS.
            for (int column = 0; column < 4; ++column) {
                patientFromIndex[column][row] =
                    sign * static_cast<double>(at<float>(280 + 16 * static_cast<std::size_t>(row) +
                                                         4 * static_cast<std::size_t>(column)));
            }
        }
    }
    [[nodiscard]] double value(glm::ivec3 index) const {
        const auto voxel = static_cast<std::size_t>(index.x + size.x * (index.y + size.y * index.z));
        const auto start = static_cast<std::size_t>(at<float>(108));
        switch (at<std::int16_t>(70)) {
            case 4:
                return at<std::int16_t>(start + 2 * voxel);
            case 512:
                return at<std::uint16_t>(start + 2 * voxel);
            case 64:
                return at<double>(start + 8 * voxel);
            default:
                return std::nan("");
        }
    }
};

class DicomTruth : public testing::TestWithParam<const char*> {};

TEST_P(DicomTruth, EveryVoxelLiesWhereTheTruthHasItsValue) {
    const fs::path folder = test::corpus() / "dicom-geometry" / GetParam();
    const auto volume = loadDicom({folder});
    ASSERT_TRUE(volume) << volume.error().text();
    const Truth truth(folder.string() + ".ground_truth.nii.gz");
    const Grid& grid = (*volume)->grid();
    ASSERT_EQ(grid.size.x * grid.size.y * grid.size.z, truth.size.x * truth.size.y * truth.size.z);
    // The truth's affine is float32: 1e-7 of positions up to 300 mm, over a spacing of 0.5 mm.
    constexpr double kPlaceTolerance = 3e-4;
    const glm::dmat4 truthFromIndex = glm::inverse(truth.patientFromIndex) * grid.patientFromIndex;
    double worstPlace = 0.0;
    double worstValue = 0.0;
    double largest = 0.0;
    for (int k = 0; k < grid.size.z; ++k) {
        for (int j = 0; j < grid.size.y; ++j) {
            for (int i = 0; i < grid.size.x; ++i) {
                const glm::dvec3 place = transformPoint(truthFromIndex, glm::dvec3(i, j, k));
                const glm::dvec3 nearest = glm::round(place);
                worstPlace = std::max(worstPlace, glm::length(place - nearest));
                const double value = truth.value(glm::ivec3(nearest));
                worstValue = std::max(worstValue, std::abs(value - (*volume)->physical({i, j, k})));
                largest = std::max(largest, std::abs(value));
            }
        }
    }
    EXPECT_LT(worstPlace, kPlaceTolerance);
    // Integers are exact; rescaled values were rounded to float32 once.
    const bool exact = (*volume)->type() != VoxelType::Float32;
    EXPECT_LE(worstValue, exact ? 0.0 : largest * 0x1p-24);
    EXPECT_GT(largest, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Series, DicomTruth,
                         testing::Values("mr-anisotropic-pixels", "mr-hitachi-double-oblique",
                                         "mr-siemens-sagittal", "mr-ge-single-slice"),
                         [](const auto& test) {
                             std::string name(test.param);
                             for (char& c : name) c = c == '-' ? '_' : c;
                             return name;
                         });

TEST(DicomTruth, CtHead64EqualsItsRawFile) {
    const fs::path folder = test::corpus() / "ct-head-64";
    const auto volume = loadDicom({folder / "dicom"});
    ASSERT_TRUE(volume) << volume.error().text();
    const std::vector<char> raw = unpacked(folder / "CTHeadAxial.raw.gz");
    const auto bytes = (*volume)->bytes();
    ASSERT_EQ(bytes.size(), raw.size());
    EXPECT_EQ(std::memcmp(bytes.data(), raw.data(), raw.size()), 0);
}

TEST(DicomTruth, SegmentedCtHasTheGridOfItsLabels) {
    // liver_seg.nrrd of the same folder: space LPS, sizes 512 512 3, origin and directions as in its header.
    const auto volume = loadDicom({test::corpus() / "dicom-seg" / "ct-3slice"});
    ASSERT_TRUE(volume) << volume.error().text();
    const Grid& grid = (*volume)->grid();
    EXPECT_EQ(grid.size, glm::ivec3(512, 512, 3));
    EXPECT_NEAR(glm::length(spacingMm(grid) - glm::dvec3(0.810547, 0.810547, 1.0)), 0.0, 1e-9);
    EXPECT_EQ(glm::dvec3(grid.patientFromIndex[3]), glm::dvec3(-235.199997, -226.800003, -128.690002));
}

}  // namespace
}  // namespace pellucid::io
