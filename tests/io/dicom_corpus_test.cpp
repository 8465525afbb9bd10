// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <glm/geometric.hpp>

#include "io/dicom_series.h"
#include "tests/support/corpus.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// Turns a name into one that a test may have.
std::string testName(std::string text) {
    for (char& c : text) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return text;
}

VolumePtr loaded(const std::string& path) {
    auto volume = loadDicom({test::corpus() / path});
    EXPECT_TRUE(volume) << volume.error().text();
    return volume ? *volume : nullptr;
}

std::string factOf(const Volume& volume, std::string_view label) {
    for (const auto& [name, text] : volume.info().facts) {
        if (name == label) return text;
    }
    return {};
}

/// What the README of the corpus says of a series.
struct Stated {
    const char* path;
    glm::ivec3 size;
    glm::dvec3 spacingMm;
    ValueRange physical;
    const char* unit;
    const char* axes;  ///< Letters that i, j and k mostly point to.
    VoxelType type;
    double tolerance;  ///< Of spacing and values: the digits the README has.
};

/// The name of a test, instead of its bytes.
void PrintTo(const Stated& stated, std::ostream* out) {
    *out << stated.path;
}

class DicomCorpus : public testing::TestWithParam<Stated> {};

TEST_P(DicomCorpus, HasSpacingOrientationAndRangeAsStated) {
    const Stated& stated = GetParam();
    const VolumePtr volume = loaded(stated.path);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->grid().size, stated.size);
    EXPECT_LT(glm::length(spacingMm(volume->grid()) - stated.spacingMm), stated.tolerance);
    EXPECT_NEAR(volume->physicalRange().lo, stated.physical.lo, stated.tolerance);
    EXPECT_NEAR(volume->physicalRange().hi, stated.physical.hi, stated.tolerance);
    EXPECT_EQ(volume->mapping().unit, stated.unit);
    EXPECT_EQ(volume->type(), stated.type);
    std::string axes;
    for (int axis = 0; axis < 3; ++axis) {
        axes += orientationLetters(glm::dvec3(volume->grid().patientFromIndex[axis])).substr(0, 1);
    }
    EXPECT_EQ(axes, stated.axes);
}

INSTANTIATE_TEST_SUITE_P(
    Series, DicomCorpus,
    testing::Values(
        Stated{
            "ct-head-64/dicom", {64, 64, 93}, {3.2, 3.2, 1.5}, {0, 3926}, "", "LPS", VoxelType::Int16, 1e-9},
        Stated{"ct-head-phantom/series-1mm-jpegls",
               {512, 512, 140},
               {0.451171875, 0.451171875, 1.0},
               {-1024, 1033},
               "HU",
               "LPS",
               VoxelType::UInt16,
               1e-9},
        Stated{"ct-head-phantom/series-5mm-jpegll",
               {512, 512, 28},
               {0.451171875, 0.451171875, 5.0},
               {-1024, 782},
               "HU",
               "LPS",
               VoxelType::UInt16,
               1e-9},
        // Slope 2.36166: 0..2803 are whole numbers in the README.
        Stated{"mr-head-mprage-jpegll",
               {256, 256, 170},
               {1, 1, 1},
               {0, 2803},
               "",
               "PIR",
               VoxelType::UInt16,
               0.5},
        Stated{"dicom-geometry/mr-siemens-sagittal",
               {256, 256, 4},
               {1, 1, 1},
               {0, 254},
               "",
               "PIR",
               VoxelType::UInt16,
               1e-9},
        Stated{"dicom-geometry/mr-hitachi-double-oblique",
               {64, 64, 4},
               {2.34375, 2.34375, 4.0},
               {0, 1537},
               "",
               "PIR",
               VoxelType::Int16,
               2e-4},
        Stated{"dicom-seg/ct-3slice",
               {512, 512, 3},
               {0.810547, 0.810547, 1.0},
               {-3024, 1381},
               "HU",
               "LPS",
               VoxelType::Int16,
               1e-9},
        Stated{"dicom-dir/98892001/CT5N",
               {16, 16, 5},
               {0.488281, 0.488281, 2.5},
               {-888, 85},
               "HU",
               "LPS",
               VoxelType::Int16,
               1e-9}),
    [](const auto& test) { return testName(test.param.path); });

TEST(DicomCorpus, RowSpacingIsTheFirstOfPixelSpacing) {
    const VolumePtr volume = loaded("dicom-geometry/mr-anisotropic-pixels");
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->grid().size, glm::ivec3(64, 28, 4));
    // Row spacing 4.0, column spacing 6.4, step 0.5.
    EXPECT_LT(glm::length(spacingMm(volume->grid()) - glm::dvec3(6.39995861, 4.0, 0.5)), 1e-6);
    EXPECT_EQ(volume->type(), VoxelType::Float32);
}

TEST(DicomCorpus, DoubleObliqueMprageRunsAsStated) {
    const VolumePtr volume = loaded("mr-head-mprage-jpegll");
    ASSERT_TRUE(volume);
    const auto& m = volume->grid().patientFromIndex;
    EXPECT_LT(glm::length(glm::dvec3(m[0]) - glm::dvec3(-0.039, 0.999, -0.002)), 1e-3);
    EXPECT_LT(glm::length(glm::dvec3(m[1]) - glm::dvec3(0.061, 0.0, -0.998)), 1e-3);
    EXPECT_DOUBLE_EQ(volume->mapping().slope, 2.36166056166056);
    ASSERT_EQ(volume->info().windows.size(), 1u);
}

TEST(DicomCorpus, GantryTiltIsKeptAndMeasured) {
    const VolumePtr volume = loaded("dicom-geometry/ct-siemens-gantry-tilt");
    ASSERT_TRUE(volume);
    EXPECT_EQ(factOf(*volume, "Gantry tilt"), "14.00 degrees");
    EXPECT_TRUE(isSheared(volume->grid()));
    // The table moves straight up; the slices are tilted.
    EXPECT_LT(glm::length(glm::dvec3(volume->grid().patientFromIndex[2]) - glm::dvec3(0, 0, 5)), 1e-9);
    EXPECT_EQ(volume->info().warnings.size(), 1u);
}

struct Refused {
    const char* path;
    ErrorCode code;
    std::vector<const char*> says;
};

void PrintTo(const Refused& refused, std::ostream* out) {
    *out << refused.path;
}

class DicomCorpusRefusal : public testing::TestWithParam<Refused> {};

TEST_P(DicomCorpusRefusal, SaysWhatAndWhere) {
    const auto volume = loadDicom({test::corpus() / GetParam().path});
    ASSERT_FALSE(volume);
    EXPECT_EQ(volume.error().code, GetParam().code) << volume.error().text();
    for (const char* part : GetParam().says) EXPECT_THAT(volume.error().text(), HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    Series, DicomCorpusRefusal,
    testing::Values(
        Refused{"ct-head-ge-tilt-deflated",
                ErrorCode::Inconsistent,
                {"not evenly spaced", "1.081 mm (14.dcm to 15.dcm)",
                 "13 x 4.002 mm, 13 x 6.999 mm, 1 x 1.081 mm", "18.50 degrees off their normal"}},
        Refused{"ct-head-phantom",
                ErrorCode::Inconsistent,
                {"2 series", "1.3.46.670589.33.1.3963937485511329090.25659488233390035616",
                 "STD BRAIN 1MM, iDose", "140 files",
                 "1.3.46.670589.33.1.6002432791750815306.26862469513794233732", "STD BRAIN 5MM", "28 files",
                 "--series"}},
        Refused{"dicom-geometry/ct-ge-uneven-increment",
                ErrorCode::Inconsistent,
                {"1 slice is missing between IM-0001-0009-0001.dcm and IM-0001-0010-0001.dcm",
                 "10 mm apart where 5 mm"}},
        Refused{"dicom-geometry/ct-siemens-coincident-slices",
                ErrorCode::Inconsistent,
                {"4 slices lie at 1 position", "001.dcm and 002.dcm", "(-139.228, -384.228, 61.500)"}},
        Refused{"dicom-geometry/mr-ge-fmri-2timepoints",
                ErrorCode::Inconsistent,
                {"8 slices lie at 4 positions", "IM-0001-0001-0001.dcm and IM-0001-0043-0001.dcm"}},
        Refused{"dicom-geometry/sc-rgb-volume-j2k", ErrorCode::Unsupported, {"a colour image"}},
        Refused{"ct-abdomen-j2k/dicom", ErrorCode::Unsupported, {"JPEG 2000"}},
        Refused{"dicom-dir/77654033/CT2", ErrorCode::Inconsistent, {"missing between 17106 and 17136"}},
        Refused{"dicom-dir/98892001/CT2N", ErrorCode::Inconsistent, {"turned by 90 degrees"}},
        Refused{"dicom-dir/TINY_ALPHA/DICOMDIR",
                ErrorCode::Corrupt,
                {"CT Image Storage: no image (it has no rows and columns)"}},
        Refused{"enhanced-multiframe",
                ErrorCode::Unsupported,
                {"Enhanced MR Image Storage: 10 frames in one file"}},
        Refused{"dicom-seg/liver.dcm", ErrorCode::Unsupported, {"Segmentation Storage: a segmentation"}},
        Refused{"dicom-rt/rtdose.dcm", ErrorCode::Unsupported, {"RT Dose Storage: 15 frames"}},
        Refused{"dicom-colour/parametric_map_float.dcm", ErrorCode::Unsupported, {"Parametric Map Storage"}},
        Refused{"dicom-malformed/pydicom/MR_truncated.dcm",
                ErrorCode::Corrupt,
                {"MR_truncated.dcm: truncated", "need 8192 bytes of pixel data, and 8130 are there"}},
        Refused{"dicom-malformed/pydicom/rtplan_truncated.dcm",
                ErrorCode::Corrupt,
                {"truncated", "976 bytes, and 711"}}),
    [](const auto& test) { return testName(test.param.path); });

TEST(DicomCorpus, DirectoryFilesNameTheSeriesOfAllPatients) {
    const auto folder = test::corpus() / "dicom-dir";
    for (const char* name :
         {"DICOMDIR", "DICOMDIR-bigEnd", "DICOMDIR-implicit", "DICOMDIR-nopatient", "DICOMDIR-reordered"}) {
        const auto scan = scanDicom({folder / name});
        ASSERT_TRUE(scan) << name << ": " << scan.error().text();
        std::size_t files = 0;
        for (const DicomSeries& series : scan->series) files += series.files.size();
        EXPECT_EQ(scan->series.size(), 10u) << name;
        EXPECT_EQ(files + scan->leftOut.size(), 31u) << name;
    }
    LoadOptions options;
    options.seriesUid = "1.3.6.1.4.1.5962.1.1.0.0.0.1194734704.16302.0.6";
    const auto volume = loadDicom({folder / "DICOMDIR"}, options);
    ASSERT_TRUE(volume) << volume.error().text();
    EXPECT_EQ((*volume)->grid().size, glm::ivec3(16, 16, 5));
}

TEST(DicomCorpus, TransferSyntaxesDecodeBitIdentically) {
    const std::string stem = "dicom-syntaxes/CTImage.dcm_";
    const VolumePtr plain = loaded(stem + "LittleEndianExplicitTransferSyntax_1.2.840.10008.1.2.1.dcm");
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->storedRange(), (ValueRange{-2000, 2402}));
    for (const char* name : {"LittleEndianImplicitTransferSyntax_1.2.840.10008.1.2",
                             "BigEndianExplicitTransferSyntax_1.2.840.10008.1.2.2",
                             "DeflatedExplicitVRLittleEndianTransferSyntax_1.2.840.10008.1.2.1.99",
                             "RLELosslessTransferSyntax_1.2.840.10008.1.2.5",
                             "JPEGProcess14TransferSyntax_1.2.840.10008.1.2.4.57",
                             "JPEGProcess14SV1TransferSyntax_1.2.840.10008.1.2.4.70",
                             "JPEGLSLosslessTransferSyntax_1.2.840.10008.1.2.4.80"}) {
        const VolumePtr volume = loaded(stem + name + ".dcm");
        ASSERT_TRUE(volume) << name;
        EXPECT_EQ(volume->grid(), plain->grid()) << name;
        EXPECT_TRUE(std::equal(volume->bytes().begin(), volume->bytes().end(), plain->bytes().begin(),
                               plain->bytes().end()))
            << name;
    }
    const VolumePtr nearlossless = loaded(stem + "JPEGLSLossyTransferSyntax_1.2.840.10008.1.2.4.81.dcm");
    ASSERT_TRUE(nearlossless);
    double worst = 0.0;
    for (int j = 0; j < 512; ++j) {
        for (int i = 0; i < 512; ++i)
            worst = std::max(worst, std::abs(nearlossless->stored({i, j, 0}) - plain->stored({i, j, 0})));
    }
    EXPECT_EQ(worst, 1.0);
    std::string warnings;
    for (const Warning& warning : nearlossless->info().warnings) warnings += warning.message;
    EXPECT_THAT(warnings, HasSubstr("compressed with loss"));
}

TEST(DicomCorpus, SmallMrDecodesBitIdentically) {
    const VolumePtr plain = loaded("dicom-syntaxes/MR_small.dcm");
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->storedRange(), (ValueRange{127, 2145}));
    for (const char* name : {"implicit", "bigendian", "expb", "RLE", "jpeg_ls_lossless", "padded"}) {
        const VolumePtr volume = loaded(fmt::format("dicom-syntaxes/MR_small_{}.dcm", name));
        ASSERT_TRUE(volume) << name;
        EXPECT_TRUE(std::equal(volume->bytes().begin(), volume->bytes().end(), plain->bytes().begin(),
                               plain->bytes().end()))
            << name;
    }
}

TEST(DicomCorpus, MalformedFilesEndWithinASecondEach) {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(test::corpus() / "dicom-malformed")) {
        if (!entry.is_regular_file()) continue;
        ++count;
        const auto start = std::chrono::steady_clock::now();
        const auto volume = loadDicom({entry.path()});
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        EXPECT_LT(taken.count(), 1.0) << entry.path();
        EXPECT_TRUE(volume || !volume.error().message.empty()) << entry.path();
    }
    EXPECT_EQ(count, 122u);  // 105 of the fuzzing corpus, 17 of pydicom.
}

TEST(DicomCorpus, AMixedFolderLoadsItsOnlySliceAndSaysWhatElseLiesThere) {
    const VolumePtr volume = loaded("dicom-rt");
    ASSERT_TRUE(volume);
    std::string warnings;
    for (const Warning& warning : volume->info().warnings) warnings += warning.message + "\n";
    EXPECT_THAT(
        warnings,
        AllOf(HasSubstr("a single slice: its extent along the normal is 3 mm by SliceThickness"),
              HasSubstr("rtplan.dcm: RT Plan Storage"), HasSubstr("rtdose.dcm: RT Dose Storage: 15 frames")));
}

}  // namespace
}  // namespace pellucid::io
