// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "io/dicom_series.h"
#include "tests/support/synthetic_dicom.h"

namespace pellucid::io {
namespace {

using test::SyntheticSeries;
using test::TemporaryFolder;
using test::writeSeries;
using testing::HasSubstr;

VolumePtr loaded(const SyntheticSeries& series) {
    const TemporaryFolder folder;
    writeSeries(series, folder.path());
    auto volume = loadDicom({folder.path()});
    EXPECT_TRUE(volume) << volume.error().text();
    return volume ? *volume : nullptr;
}

/// Every voxel has the physical value that the series defines, at the place that it defines.
void expectAsDefined(const SyntheticSeries& s, const Volume& volume) {
    const Grid& grid = volume.grid();
    ASSERT_EQ(grid.size, glm::ivec3(s.size, s.slices));
    // DS holds 12 significant digits here; positions are below 1000 mm.
    constexpr double kTolerance = 1e-8;
    double worstPlace = 0.0;
    for (int k = 0; k < s.slices; ++k) {
        for (int j = 0; j < s.size.y; ++j) {
            for (int i = 0; i < s.size.x; ++i) {
                ASSERT_DOUBLE_EQ(volume.physical({i, j, k}),
                                 static_cast<double>(s.value(i, j, k)) * s.slope + s.intercept);
                const glm::dvec3 defined = s.originMm + s.rowDirection * (s.spacingMm.x * i) +
                                           s.columnDirection * (s.spacingMm.y * j) +
                                           s.stepMm * static_cast<double>(k);
                const glm::dvec3 found = transformPoint(grid.patientFromIndex, glm::dvec3(i, j, k));
                worstPlace = std::max(worstPlace, glm::length(found - defined));
            }
        }
    }
    EXPECT_LT(worstPlace, kTolerance);
}

std::string factOf(const Volume& volume, std::string_view label) {
    for (const auto& [name, text] : volume.info().facts) {
        if (name == label) return text;
    }
    return {};
}

std::string warningsOf(const Volume& volume) {
    std::string all;
    for (const Warning& warning : volume.info().warnings) all += warning.message + "\n";
    return all;
}

TEST(DicomSeries, PlacesAndValuesAnAxialSeries) {
    const SyntheticSeries series;
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    expectAsDefined(series, *volume);
    EXPECT_EQ(volume->type(), VoxelType::UInt16);
    EXPECT_EQ(volume->mapping(), (ValueMapping{1.0, -1024.0, "HU"}));
    EXPECT_EQ(volume->info().modality, "CT");
    EXPECT_EQ(volume->info().name, "Synthetic");
    EXPECT_EQ(warningsOf(*volume), "");
    EXPECT_EQ(factOf(*volume, "Files"), "4");
    EXPECT_EQ(factOf(*volume, "Slice thickness"), "99 mm");
}

TEST(DicomSeries, PlacesObliqueSlices) {
    SyntheticSeries series;
    series.rowDirection = glm::normalize(glm::dvec3(0.8, 0.5, -0.2));
    series.columnDirection = glm::normalize(glm::cross(glm::dvec3(0.1, -0.3, 0.9), series.rowDirection));
    series.stepMm = 3.5 * glm::cross(series.rowDirection, series.columnDirection);
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    expectAsDefined(series, *volume);
    EXPECT_FALSE(isSheared(volume->grid()));
}

TEST(DicomSeries, KeepsGantryTiltAsShear) {
    SyntheticSeries series;
    const double angle = glm::radians(-20.0);
    series.columnDirection = {0, std::cos(angle), std::sin(angle)};
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    expectAsDefined(series, *volume);
    EXPECT_TRUE(isSheared(volume->grid()));
    EXPECT_EQ(factOf(*volume, "Gantry tilt"), "20.00 degrees");
    EXPECT_THAT(warningsOf(*volume), HasSubstr("20.00 degrees"));
}

TEST(DicomSeries, OrdersSlicesAcquiredAgainstTheNormal) {
    SyntheticSeries series;
    series.stepMm = {0, 0, -2.5};
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    // The volume runs along the normal, so its first slice is the last one written.
    EXPECT_EQ(volume->grid().patientFromIndex[2], glm::dvec4(0, 0, 2.5, 0));
    EXPECT_EQ(volume->grid().patientFromIndex[3], glm::dvec4(-20, -30, 92.5, 1));
    EXPECT_DOUBLE_EQ(volume->stored({2, 1, 0}), 312.0);
    EXPECT_DOUBLE_EQ(volume->stored({2, 1, 3}), 12.0);
}

struct FormatCase {
    const char* name;
    int allocated;
    int stored;
    int high;
    bool isSigned;
    VoxelType type;
    test::DicomEncoding encoding;
};

/// The name of a test, instead of its bytes.
void PrintTo(const FormatCase& format, std::ostream* out) {
    *out << format.name;
}

class DicomFormat : public testing::TestWithParam<FormatCase> {};

TEST_P(DicomFormat, ReadsTheFullRange) {
    const FormatCase& c = GetParam();
    SyntheticSeries series;
    series.bitsAllocated = c.allocated;
    series.bitsStored = c.stored;
    series.highBit = c.high;
    series.isSigned = c.isSigned;
    series.encoding = c.encoding;
    series.slope = 0.25;
    const std::int64_t count = std::int64_t{1} << c.stored;
    const std::int64_t lowest = c.isSigned ? -count / 2 : 0;
    // Voxel 0 has the lowest value, the last voxel the highest.
    const std::int64_t voxels = std::int64_t{series.size.x} * series.size.y * series.slices;
    series.value = [=, size = series.size](int i, int j, int k) {
        const std::int64_t index = i + std::int64_t{size.x} * (j + std::int64_t{size.y} * k);
        return lowest + index * (count - 1) / (voxels - 1);
    };
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->type(), c.type);
    EXPECT_EQ(volume->storedRange(),
              (ValueRange{static_cast<double>(lowest), static_cast<double>(lowest + count - 1)}));
    expectAsDefined(series, *volume);
}

using E = test::DicomEncoding;
INSTANTIATE_TEST_SUITE_P(
    All, DicomFormat,
    testing::Values(FormatCase{"Unsigned8", 8, 8, 7, false, VoxelType::UInt8, E::ExplicitLittle},
                    FormatCase{"Signed8", 8, 8, 7, true, VoxelType::Int8, E::ExplicitLittle},
                    FormatCase{"Unsigned7In8", 8, 7, 6, false, VoxelType::UInt8, E::ImplicitLittle},
                    FormatCase{"Unsigned12In16", 16, 12, 11, false, VoxelType::UInt16, E::ExplicitLittle},
                    FormatCase{"Signed12In16", 16, 12, 11, true, VoxelType::Int16, E::ExplicitLittle},
                    FormatCase{"Signed12AtTheTop", 16, 12, 15, true, VoxelType::Int16, E::ExplicitLittle},
                    FormatCase{"Signed16", 16, 16, 15, true, VoxelType::Int16, E::ImplicitLittle},
                    FormatCase{"Unsigned16", 16, 16, 15, false, VoxelType::UInt16, E::ExplicitLittle},
                    FormatCase{"Signed16Big", 16, 16, 15, true, VoxelType::Int16, E::ExplicitBig},
                    FormatCase{"Unsigned12Big", 16, 12, 11, false, VoxelType::UInt16, E::ExplicitBig},
                    FormatCase{"Unsigned32", 32, 32, 31, false, VoxelType::UInt32, E::ExplicitLittle},
                    FormatCase{"Signed32", 32, 32, 31, true, VoxelType::Int32, E::ImplicitLittle}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(DicomSeries, MasksWhatLiesBesideTheStoredBits) {
    SyntheticSeries series;
    series.isSigned = true;
    series.value = [](int i, int j, int k) { return i + j + k - 8; };
    series.edit = [](test::SyntheticFile& file, int) {
        // 7 x 5 pixels of -1 in 12 bits, with an old overlay in the four bits above.
        std::vector<std::uint8_t> pixels;
        for (int n = 0; n < 35; ++n)
            pixels.insert(pixels.end(), {0xFF, static_cast<std::uint8_t>(n % 2 == 0 ? 0x0F : 0x5F)});
        file.setPixels(pixels, 2);
    };
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->storedRange(), (ValueRange{-1, -1}));
}

TEST(DicomSeries, ConvertsSlicesOfDifferentRescaleToFloat) {
    SyntheticSeries series;
    series.edit = [](test::SyntheticFile& file, int k) {
        file.setText(0x00281053, "DS", test::decimalText({0.5 + k}));
        file.setText(0x00281052, "DS", test::decimalText({10.0 * k}));
    };
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->type(), VoxelType::Float32);
    EXPECT_EQ(volume->mapping(), (ValueMapping{1.0, 0.0, "HU"}));
    for (int k = 0; k < series.slices; ++k) {
        EXPECT_DOUBLE_EQ(volume->physical({3, 2, k}), (23 + 100 * k) * (0.5 + k) + 10.0 * k);
    }
    EXPECT_THAT(warningsOf(*volume), HasSubstr("slope and intercept differ between slices"));
}

TEST(DicomSeries, WidensSlicesOfDifferentSignedness) {
    SyntheticSeries series;
    series.bitsStored = 16;
    series.highBit = 15;
    series.edit = [](test::SyntheticFile& file, int k) {
        file.setShort(0x00280103, k == 1 ? 1 : 0);
        if (k == 1) file.setPixels(std::vector<std::uint8_t>(70, 0xFF), 2);
        if (k == 2) file.setPixels(std::vector<std::uint8_t>(70, 0xFE), 2);
    };
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->type(), VoxelType::Int32);
    EXPECT_DOUBLE_EQ(volume->stored({0, 0, 1}), -1.0);
    EXPECT_DOUBLE_EQ(volume->stored({0, 0, 2}), 0xFEFE);
}

TEST(DicomSeries, TellsWindowsPaddingAndUnit) {
    SyntheticSeries series;
    series.edit = [](test::SyntheticFile& file, int) {
        file.setText(0x00281050, "DS", "40\\40\\-600\\5");
        file.setText(0x00281051, "DS", "80\\80\\1500\\0");
        file.setText(0x00281055, "LO", "BRAIN\\BRAIN2\\LUNG\\NONE");
        file.setText(0x00281054, "LO", "US");
        file.setShort(0x00280120, 63536);
    };
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->info().windows,
              (std::vector<NamedWindow>{{"BRAIN", {40, 80}}, {"LUNG", {-600, 1500}}}));
    EXPECT_EQ(volume->mapping().unit, "");
    EXPECT_EQ(factOf(*volume, "Pixel padding value"), "63536");
}

TEST(DicomSeries, CarriesNoPatientData) {
    SyntheticSeries series;
    series.description.clear();
    series.edit = [](test::SyntheticFile& file, int) {
        file.setText(0x00100010, "PN", "Doe^Jane");
        file.setText(0x00100020, "LO", "SECRET-ID");
    };
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    std::string all = volume->info().name + warningsOf(*volume);
    for (const auto& [label, text] : volume->info().facts) all += label + text;
    EXPECT_EQ(all.find("Doe"), std::string::npos);
    EXPECT_EQ(all.find("SECRET"), std::string::npos);
}

TEST(DicomSeries, AcceptsPixelsWithTrailingPadding) {
    SyntheticSeries series;
    series.edit = [](test::SyntheticFile& file, int) { file.setPixels(std::vector<std::uint8_t>(80, 1), 2); };
    const VolumePtr volume = loaded(series);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->storedRange(), (ValueRange{257, 257}));
}

TEST(DicomSeries, ReportsProgressAndCanBeCancelled) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    series.slices = 20;
    writeSeries(series, folder.path());
    LoadOptions options;
    double last = 0.0;
    options.progress = [&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        return true;
    };
    EXPECT_TRUE(loadDicom({folder.path()}, options));
    EXPECT_DOUBLE_EQ(last, 1.0);
    for (const double stopAt : {0.0, 0.1, 0.3, 0.5}) {
        options.progress = [&](double fraction, std::string_view) { return fraction < stopAt; };
        const auto volume = loadDicom({folder.path()}, options);
        ASSERT_FALSE(volume);
        EXPECT_EQ(volume.error().code, ErrorCode::Cancelled);
    }
}

TEST(DicomSeries, ALargeSeriesShowsACoarseCopyFirst) {
    SyntheticSeries series;
    series.size = {512, 510};
    series.slices = 63;  // 16.4 million voxels.
    series.value = [](int i, int j, int k) { return (7 * i + 13 * j + 31 * k) % 4096; };
    const TemporaryFolder folder;
    writeSeries(series, folder.path());
    std::vector<VolumePtr> coarse;
    std::vector<double> fractions;
    LoadOptions options;
    options.coarse = [&](VolumePtr copy) {
        coarse.push_back(std::move(copy));
        EXPECT_LT(fractions.back(), 0.6) << "most slices are not decoded yet";
    };
    options.progress = [&](double fraction, std::string_view) {
        EXPECT_TRUE(fractions.empty() || fraction >= fractions.back());
        fractions.push_back(fraction);
        return true;
    };
    const auto whole = loadDicom({folder.path()}, options);
    ASSERT_TRUE(whole) << whole.error().text();
    EXPECT_EQ(fractions.back(), 1.0);
    ASSERT_EQ(coarse.size(), 1u);
    const Volume& copy = *coarse.front();
    ASSERT_EQ(copy.grid().size, glm::ivec3(128, 128, 16));
    EXPECT_EQ(copy.mapping(), (*whole)->mapping());
    EXPECT_EQ(copy.info().modality, (*whole)->info().modality);
    for (const glm::ivec3 index : {glm::ivec3(0, 0, 0), {127, 127, 15}, {3, 77, 9}, {126, 0, 1}}) {
        EXPECT_EQ(copy.stored(index), (*whole)->stored(4 * index));
        EXPECT_LT(glm::distance(transformPoint(copy.grid().patientFromIndex, glm::dvec3(index)),
                                transformPoint((*whole)->grid().patientFromIndex, glm::dvec3(4 * index))),
                  1e-9);
    }
    // The copy is made on the way: the whole is what it is without one. Every 11th voxel along each axis.
    for (int k = 0; k < series.slices; k += 11)
        for (int j = 0; j < series.size.y; j += 11)
            for (int i = 0; i < series.size.x; i += 11)
                ASSERT_EQ((*whole)->stored({i, j, k}), static_cast<double>(series.value(i, j, k)));
}

TEST(DicomSeries, ASmallSeriesIsThereBeforeACopyWouldBe) {
    const TemporaryFolder folder;
    writeSeries(SyntheticSeries{}, folder.path());
    LoadOptions options;
    options.coarse = [](const VolumePtr&) { ADD_FAILURE(); };
    EXPECT_TRUE(loadDicom({folder.path()}, options));
}

}  // namespace
}  // namespace pellucid::io
