// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

using test::bytesOf;
using test::gzipped;
using test::NiftiFile;
using test::ramp;
using testing::HasSubstr;

const std::string kVoxels = bytesOf(ramp<std::int16_t>(24));

/// A sheared, oblique sform whose numbers are exact in float.
NiftiFile oblique() {
    NiftiFile nifti;
    nifti.srow = {2, 0.5, 0, 10, 0, 0, 4, -20, 0.25, -3, 1, 30};
    nifti.pixdim = {1, 2, 3, 4, 0, 0, 0, 0};
    return nifti;
}

/// The same in LPS: rows x and y change sign.
glm::dmat4 obliqueLps() {
    return {{-2, 0, 0.25, 0}, {-0.5, 0, -3, 0}, {0, -4, 1, 0}, {-10, 20, 30, 1}};
}

TEST(Nifti, SformFromRasToLpsInEveryFormOfTheFile) {
    const test::TempFolder folder;
    for (const int version : {1, 2}) {
        for (const bool big : {false, true}) {
            NiftiFile nifti = oblique();
            nifti.version = version;
            nifti.bigEndian = big;
            const std::string voxels = bytesOf(ramp<std::int16_t>(24), big);
            std::vector<std::filesystem::path> files{folder.write("a.nii", nifti.file(voxels)),
                                                     folder.write("b.nii.gz", gzipped(nifti.file(voxels)))};
            nifti.pair = true;
            files.push_back(folder.write("c.hdr", nifti.header()));
            folder.write("c.img", voxels);
            files.push_back(folder.write("d.hdr.gz", gzipped(nifti.header())));
            folder.write("d.img.gz", gzipped(voxels));
            for (const auto& file : files) {
                SCOPED_TRACE(file.filename().string() + " version " + std::to_string(version) +
                             (big ? " big" : " little"));
                const auto volume = loaded(file);
                ASSERT_TRUE(volume);
                EXPECT_EQ(volume->grid().size, glm::ivec3(4, 3, 2));
                expectPlaced(volume->grid(), obliqueLps(), 0.0);
                EXPECT_TRUE(isSheared(volume->grid()));
                expectVoxels(*volume, ramp<std::int16_t>(24));
                EXPECT_EQ(warningsOf(*volume), "");
            }
        }
    }
}

/// 90 degrees about the third axis, offset (10, 20, 30), spacing (2, 3, 4).
NiftiFile turned(double qfac) {
    NiftiFile nifti;
    nifti.sformCode = 0;
    nifti.qformCode = 1;
    nifti.pixdim = {qfac, 2, 3, 4, 0, 0, 0, 0};
    nifti.quatern = {0, 0, std::sqrt(0.5), 10, 20, 30};
    return nifti;
}

TEST(Nifti, QformRotatesScalesAndMirrors) {
    const test::TempFolder folder;
    for (const double qfac : {1.0, -1.0}) {
        const auto volume = loaded(folder.write("a.nii", turned(qfac).file(kVoxels)));
        ASSERT_TRUE(volume);
        // RAS columns (0, 2, 0), (-3, 0, 0), (0, 0, 4 qfac). The quaternion is a float: its error of 2^-25
        // enters an entry four times, multiplied by the spacing of at most 4.
        expectPlaced(volume->grid(), {{0, -2, 0, 0}, {3, 0, 0, 0}, {0, 0, 4 * qfac, 0}, {-10, -20, 30, 1}},
                     16.0 / (1 << 25));
    }
    // A pixdim[0] of 0 counts as 1.
    EXPECT_GT(loaded(folder.write("a.nii", turned(0.0).file(kVoxels)))->grid().patientFromIndex[2].z, 0.0);
}

TEST(Nifti, DisagreeingFormsAreSaidWithTheDistance) {
    const test::TempFolder folder;
    NiftiFile nifti;
    nifti.qformCode = 1;
    nifti.quatern = {0, 0, 0, 3, 4, 0};  // the sform's origin is 0, 0, 0: every corner moves by 5 mm
    const auto volume = loaded(folder.write("a.nii", nifti.file(kVoxels)));
    ASSERT_TRUE(volume);
    EXPECT_THAT(warningsOf(*volume), HasSubstr("disagree by up to 5 mm"));
    EXPECT_EQ(volume->grid().patientFromIndex[3], glm::dvec4(0, 0, 0, 1));
    nifti.quatern = {0, 0, 0, 0.01, 0, 0};
    EXPECT_EQ(warningsOf(*loaded(folder.write("b.nii", nifti.file(kVoxels)))), "");
}

TEST(Nifti, WithoutEitherFormTheOrientationIsNotGuessedSilently) {
    const test::TempFolder folder;
    NiftiFile nifti;
    nifti.sformCode = 0;
    nifti.pixdim = {1, 2, 3, 4, 0, 0, 0, 0};
    const auto volume = loaded(folder.write("a.nii", nifti.file(kVoxels)));
    ASSERT_TRUE(volume);
    EXPECT_THAT(warningsOf(*volume), HasSubstr("the orientation is not stated"));
    EXPECT_EQ(spacingMm(volume->grid()), glm::dvec3(2, 3, 4));
}

TEST(Nifti, LengthUnitsBecomeMillimetres) {
    const test::TempFolder folder;
    NiftiFile nifti = oblique();
    nifti.units = 1;  // metres
    const auto volume = loaded(folder.write("a.nii", nifti.file(kVoxels)));
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->grid().patientFromIndex[3], glm::dvec4(-10000, 20000, 30000, 1));
    nifti.units = 5;
    EXPECT_THAT(warningsOf(*loaded(folder.write("b.nii", nifti.file(kVoxels)))), HasSubstr("unit code is 5"));
}

TEST(Nifti, SlopeInterceptAndWindow) {
    const test::TempFolder folder;
    NiftiFile nifti;
    nifti.slope = 0.5;
    nifti.inter = -1024;
    nifti.calMin = 40;
    nifti.calMax = 80;
    const auto scaled = loaded(folder.write("a.nii", nifti.file(kVoxels)));
    ASSERT_TRUE(scaled);
    EXPECT_EQ(scaled->physical({3, 2, 1}), 18 * 0.5 - 1024);
    ASSERT_EQ(scaled->info().windows.size(), 1u);
    EXPECT_EQ(scaled->info().windows[0].window, (Window{60, 40}));
    for (const double none :
         {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        nifti.slope = none;
        const auto volume = loaded(folder.write("b.nii", nifti.file(kVoxels)));
        ASSERT_TRUE(volume);
        EXPECT_EQ(volume->mapping(), ValueMapping{});
    }
}

TEST(Nifti, ComponentsFromVectorsAndColours) {
    const test::TempFolder folder;
    NiftiFile fifth;
    fifth.dim = {5, 2, 1, 1, 1, 3, 1, 1};
    const auto vectors = loaded(folder.write("a.nii", fifth.file(bytesOf<std::int16_t>({1, 2, 3, 4, 5, 6}))));
    ASSERT_TRUE(vectors);
    expectVoxels<std::int16_t>(*vectors, {1, 3, 5, 2, 4, 6});
    NiftiFile fourth = fifth;
    fourth.dim = {4, 2, 1, 1, 3, 1, 1, 1};
    fourth.intent = 2003;
    EXPECT_EQ(
        loaded(folder.write("b.nii", fourth.file(bytesOf<std::int16_t>({1, 2, 3, 4, 5, 6}))))->components(),
        3);
    NiftiFile colour;
    colour.dim = {3, 2, 1, 1, 1, 1, 1, 1};
    colour.datatype = 128;
    colour.bitpix = 24;
    colour.slope = 2.0;  // does not hold for colours
    const auto rgb = loaded(folder.write("c.nii", colour.file(bytesOf<std::uint8_t>({1, 2, 3, 4, 5, 6}))));
    ASSERT_TRUE(rgb);
    EXPECT_EQ(rgb->components(), 3);
    EXPECT_EQ(rgb->physical({1, 0, 0}, 0), 4);
}

TEST(Nifti, WideIntegersAreNarrowed) {
    const test::TempFolder folder;
    NiftiFile nifti;
    nifti.dim = {3, 2, 1, 1, 1, 1, 1, 1};
    nifti.datatype = 1280;
    nifti.bitpix = 64;
    const auto volume = loaded(folder.write("a.nii", nifti.file(bytesOf<std::uint64_t>({7, 4000000000ull}))));
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->type(), VoxelType::UInt32);
    EXPECT_THAT(warningsOf(*volume), HasSubstr("worst error is 0"));
}

TEST(Nifti, WhatIsCutOffIsRefusedWithNumbers) {
    const test::TempFolder folder;
    const NiftiFile nifti = oblique();
    expectRefused(folder.write("a.nii", nifti.file(kVoxels.substr(0, 30))), ErrorCode::Corrupt,
                  {"= 48 bytes", "found 30 bytes"});
    expectRefused(folder.write("a.nii", nifti.header().substr(0, 200)), ErrorCode::Corrupt,
                  {"expected 348 bytes, found 200"});
    const std::string packed = gzipped(nifti.file(kVoxels));
    for (std::size_t length = 0; length < packed.size(); ++length)
        refusal(folder.write("b.nii.gz", packed.substr(0, length)));
    NiftiFile pair = nifti;
    pair.pair = true;
    expectRefused(folder.write("c.hdr", pair.header()), ErrorCode::NotFound, {"c.img"});
    folder.write("c.img", kVoxels.substr(0, 47));
    expectRefused(folder.path() / "c.hdr", ErrorCode::Corrupt, {"found 47 bytes"});
    NiftiFile huge = nifti;
    huge.version = 2;
    huge.dim = {3, 2000000000, 2000000000, 2000000000, 1, 1, 1, 1};
    expectRefused(folder.write("d.nii", huge.file(kVoxels)), ErrorCode::TooLarge, {"2000000000"});
    huge.dim = {3, 1000, 1000, 5000, 1, 1, 1, 1};
    expectRefused(folder.write("e.nii.gz", gzipped(huge.file(kVoxels))), ErrorCode::Corrupt, {"cannot hold"});
}

TEST(Nifti, OtherThingsAreRefusedByName) {
    const test::TempFolder folder;
    const auto with = [&](auto&& change) {
        NiftiFile nifti = oblique();
        change(nifti);
        return folder.write("a.nii", nifti.file(std::string(4096, '\0')));
    };
    expectRefused(with([](NiftiFile& n) { n.dim = {4, 4, 3, 2, 24, 1, 1, 1}; }), ErrorCode::Unsupported,
                  {"4D, 24 time steps", "not yet"});
    expectRefused(with([](NiftiFile& n) { n.dim = {5, 4, 3, 2, 1, 7, 1, 1}; }), ErrorCode::Unsupported,
                  {"7 components"});
    expectRefused(with([](NiftiFile& n) { n.datatype = 32, n.bitpix = 64; }), ErrorCode::Unsupported,
                  {"complex"});
    expectRefused(with([](NiftiFile& n) { n.datatype = 1536, n.bitpix = 128; }), ErrorCode::Unsupported,
                  {"1536"});
    expectRefused(with([](NiftiFile& n) { n.bitpix = 8; }), ErrorCode::Corrupt, {"bitpix is 8"});
    expectRefused(with([](NiftiFile& n) { n.dim = {3, 4, -3, 2, 1, 1, 1, 1}; }), ErrorCode::Corrupt,
                  {"dim[2] is -3"});
    expectRefused(with([](NiftiFile& n) { n.dim = {9, 4, 3, 2, 1, 1, 1, 1}; }), ErrorCode::Corrupt,
                  {"dim[0] is 9"});
    expectRefused(with([](NiftiFile& n) { n.srow.fill(0.0); }), ErrorCode::Corrupt, {"placement"});
    expectRefused(with([](NiftiFile& n) { n.srow[0] = std::nan(""); }), ErrorCode::Corrupt, {"placement"});
    std::string analyze = oblique().header();
    analyze.replace(344, 4, std::string(4, '\0'));
    expectRefused(folder.write("b.hdr", analyze), ErrorCode::Unsupported, {"ANALYZE"});
}

}  // namespace
}  // namespace pellucid::io
