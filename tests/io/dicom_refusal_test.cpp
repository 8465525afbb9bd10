// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/dicom_series.h"
#include "tests/support/synthetic_dicom.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;
using test::SyntheticFile;
using test::SyntheticSeries;
using test::TemporaryFolder;
using test::writeSeries;
using testing::AllOf;
using testing::HasSubstr;

Error refusalOf(const SyntheticSeries& series, const LoadOptions& options = {}) {
    const TemporaryFolder folder;
    writeSeries(series, folder.path());
    const auto volume = loadDicom({folder.path()}, options);
    if (volume) return {ErrorCode::InvalidArgument, "it was loaded", {}};
    return volume.error();
}

/// The series with a change of one slice.
SyntheticSeries changed(int slice, std::function<void(SyntheticFile&)> change) {
    SyntheticSeries series;
    series.edit = [=](SyntheticFile& file, int k) {
        if (k == slice) change(file);
    };
    return series;
}

TEST(DicomRefusal, MissingSlice) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    series.slices = 6;
    fs::remove(writeSeries(series, folder.path())[3]);
    const auto volume = loadDicom({folder.path()});
    ASSERT_FALSE(volume);
    EXPECT_EQ(volume.error().code, ErrorCode::Inconsistent);
    // Slice k lies in im{6 - k}.
    EXPECT_THAT(volume.error().text(),
                AllOf(HasSubstr("Synthetic"), HasSubstr("1 slice is missing between im004.dcm and im002.dcm"),
                      HasSubstr("5 mm apart where 2.5 mm is the step")));
}

TEST(DicomRefusal, DuplicatePosition) {
    const Error error =
        refusalOf(changed(2, [](SyntheticFile& f) { f.setText(0x00200032, "DS", "-20\\-30\\102.5"); }));
    EXPECT_EQ(error.code, ErrorCode::Inconsistent);
    EXPECT_THAT(error.message, AllOf(HasSubstr("4 slices lie at 3 positions"), HasSubstr("im002.dcm"),
                                     HasSubstr("im003.dcm")));
}

TEST(DicomRefusal, UnevenSpacing) {
    const Error error =
        refusalOf(changed(3, [](SyntheticFile& f) { f.setText(0x00200032, "DS", "-20\\-30\\108.5"); }));
    EXPECT_EQ(error.code, ErrorCode::Inconsistent);
    EXPECT_THAT(error.message, AllOf(HasSubstr("not evenly spaced"), HasSubstr("2.5 mm"),
                                     HasSubstr("3.5 mm (im002.dcm to im001.dcm)")));
}

TEST(DicomRefusal, MixedOrientationAndSize) {
    Error error =
        refusalOf(changed(1, [](SyntheticFile& f) { f.setText(0x00200037, "DS", "0\\1\\0\\0\\0\\-1"); }));
    EXPECT_EQ(error.code, ErrorCode::Inconsistent);
    EXPECT_THAT(error.message, AllOf(HasSubstr("im003.dcm"), HasSubstr("turned by 90 degrees")));
    error = refusalOf(changed(1, [](SyntheticFile& f) { f.setShort(0x00280010, 4); }));
    EXPECT_THAT(error.message, AllOf(HasSubstr("7 x 5"), HasSubstr("im003.dcm has 7 x 4")));
}

TEST(DicomRefusal, MissingGeometry) {
    for (const std::uint32_t tag : {0x00200032u, 0x00200037u, 0x00280030u}) {
        const Error error = refusalOf(changed(2, [&](SyntheticFile& f) { f.erase(tag); }));
        EXPECT_EQ(error.code, ErrorCode::Unsupported);
        EXPECT_THAT(error.message, AllOf(HasSubstr("im002.dcm: no geometry"), HasSubstr(" 0 of ")));
    }
}

TEST(DicomRefusal, TruncatedAnywhere) {
    const TemporaryFolder folder;
    const auto files = writeSeries({}, folder.path());
    std::ifstream stream(files[1], std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(stream)), {});
    stream.close();
    // Every length from inside the first element of the data set to one byte short.
    for (std::size_t length = 180; length < whole.size(); ++length) {
        std::ofstream(files[1], std::ios::binary) << whole.substr(0, length);
        const auto volume = loadDicom({folder.path()});
        // Also when it is cut between two elements and looks whole.
        ASSERT_FALSE(volume) << length;
        ASSERT_EQ(volume.error().code, ErrorCode::Corrupt) << length << ": " << volume.error().text();
        ASSERT_THAT(volume.error().text(), HasSubstr("im003.dcm")) << length;
    }
    const auto inPixels = loadDicom({folder.path()});
    // 7 x 5 pixels of 2 bytes, one byte short.
    EXPECT_THAT(inPixels.error().message,
                HasSubstr(fmt::format(
                    "truncated: 7 x 5 pixels need 70 bytes of pixel data, and 69 are there (the file ends at "
                    "byte {})",
                    whole.size() - 1)));
}

TEST(DicomRefusal, SliceWithoutPixels) {
    Error error = refusalOf(changed(3, [](SyntheticFile& f) { f.erase(0x7FE00010); }));
    EXPECT_EQ(error.code, ErrorCode::Corrupt);
    EXPECT_THAT(error.message, HasSubstr("im001.dcm: CT Image Storage: no pixel data"));
    error = refusalOf(changed(3, [](SyntheticFile& f) { f.erase(0x00280010); }));
    EXPECT_THAT(error.message, HasSubstr("im001.dcm: CT Image Storage: no image"));
}

TEST(DicomRefusal, PixelDataShorterThanTheSize) {
    const Error error = refusalOf(changed(0, [](SyntheticFile& f) { f.setShort(0x00280010, 60000); }));
    EXPECT_EQ(error.code, ErrorCode::Corrupt);
    EXPECT_THAT(error.message, AllOf(HasSubstr("im004.dcm"),
                                     HasSubstr("need 840000 bytes of pixel data, and 70 are there")));
}

TEST(DicomRefusal, ImpossiblePixelFormats) {
    const auto bits = [](int allocated, int stored, int high, int representation) {
        return refusalOf(changed(0, [=](SyntheticFile& f) {
            f.setShort(0x00280100, static_cast<std::uint16_t>(allocated));
            f.setShort(0x00280101, static_cast<std::uint16_t>(stored));
            f.setShort(0x00280102, static_cast<std::uint16_t>(high));
            f.setShort(0x00280103, static_cast<std::uint16_t>(representation));
        }));
    };
    EXPECT_EQ(bits(16, 17, 16, 0).code, ErrorCode::Corrupt);
    EXPECT_EQ(bits(16, 12, 16, 0).code, ErrorCode::Corrupt);
    EXPECT_EQ(bits(16, 12, 10, 0).code, ErrorCode::Corrupt);
    EXPECT_EQ(bits(16, 0, 0, 0).code, ErrorCode::Corrupt);
    EXPECT_EQ(bits(16, 12, 11, 2).code, ErrorCode::Corrupt);
    EXPECT_EQ(bits(12, 12, 11, 0).code, ErrorCode::Unsupported);
    EXPECT_EQ(bits(0, 0, 0, 0).code, ErrorCode::Unsupported);
    const Error unsaid = refusalOf(changed(0, [](SyntheticFile& f) { f.erase(0x00280103); }));
    EXPECT_THAT(unsaid.message, HasSubstr("PixelRepresentation is missing"));
}

TEST(DicomRefusal, NumbersThatAreNone) {
    Error error =
        refusalOf(changed(3, [](SyntheticFile& f) { f.setText(0x00200032, "DS", "-20\\-30\\1O7.5"); }));
    EXPECT_EQ(error.code, ErrorCode::Corrupt);
    EXPECT_THAT(error.message,
                HasSubstr("im001.dcm: ImagePositionPatient holds \"1O7.5\", which is no number"));
    error = refusalOf(changed(3, [](SyntheticFile& f) { f.setText(0x00200032, "DS", "-20\\-30\\nan"); }));
    EXPECT_EQ(error.code, ErrorCode::Corrupt);
    error = refusalOf(changed(3, [](SyntheticFile& f) { f.setText(0x00281053, "DS", "0"); }));
    EXPECT_THAT(error.message, HasSubstr("a rescale slope of 0"));
    error = refusalOf(changed(3, [](SyntheticFile& f) { f.setText(0x00281052, "DS", "12,5"); }));
    EXPECT_THAT(error.message, HasSubstr("RescaleIntercept holds \"12,5\""));
}

TEST(DicomRefusal, ObjectsOfOtherKinds) {
    SyntheticSeries series;
    const std::vector<std::pair<std::function<void(SyntheticFile&, int)>, const char*>> kinds{
        {[](SyntheticFile& f, int) { f.setText(0x00280008, "IS", "3"); }, "3 frames in one file"},
        {[](SyntheticFile& f, int) { f.setShort(0x00280002, 3); }, "a colour image"},
        {[](SyntheticFile& f, int) { f.setText(0x00280004, "CS", "PALETTE COLOR"); }, "\"PALETTE COLOR\""},
        {[](SyntheticFile& f, int) { f.setText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66.4"); },
         "Segmentation Storage: a segmentation"}};
    for (const auto& [edit, reason] : kinds) {
        series.edit = edit;
        const Error error = refusalOf(series);
        EXPECT_EQ(error.code, ErrorCode::Unsupported);
        EXPECT_THAT(error.message, HasSubstr(reason));
    }
}

TEST(DicomRefusal, MoreVoxelsThanTheLimit) {
    LoadOptions options;
    options.maxVoxelBytes = 7 * 5 * 4 * 2 - 1;
    const Error error = refusalOf({}, options);
    EXPECT_EQ(error.code, ErrorCode::TooLarge);
    EXPECT_THAT(error.message, HasSubstr("7 x 5 x 4 voxels of 2 bytes"));
    options.maxVoxelBytes = 7 * 5 * 4 * 2;
    EXPECT_EQ(refusalOf({}, options).message, "it was loaded");
}

}  // namespace
}  // namespace pellucid::io
