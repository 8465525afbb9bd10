// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

using test::bytesOf;
using test::gzipped;
using test::ramp;
using testing::HasSubstr;

const std::string kHead = "NRRD0004\n# comment\ntype: short\ndimension: 3\nsizes: 4 3 2\nendian: little\n";
const std::string kPlace = "space directions: (2,0,0.25) (0.5,0,-3) (0,4,1)\nspace origin: (10,-20,30)\n";
const std::string kVoxels = bytesOf(ramp<std::int16_t>(24));

glm::dmat4 placed(glm::dvec3 signs) {
    const glm::dvec3 i = glm::dvec3(2, 0, 0.25) * signs;
    const glm::dvec3 j = glm::dvec3(0.5, 0, -3) * signs;
    const glm::dvec3 k = glm::dvec3(0, 4, 1) * signs;
    return {glm::dvec4(i, 0), glm::dvec4(j, 0), glm::dvec4(k, 0),
            glm::dvec4(glm::dvec3(10, -20, 30) * signs, 1)};
}

TEST(Nrrd, DirectionsAreKeptInEverySpaceOfAPatient) {
    const test::TempFolder folder;
    for (const auto& [space, signs] : {std::pair{"left-posterior-superior", glm::dvec3(1, 1, 1)},
                                       std::pair{"right-anterior-superior", glm::dvec3(-1, -1, 1)},
                                       std::pair{"RAS", glm::dvec3(-1, -1, 1)},
                                       std::pair{"left-anterior-superior", glm::dvec3(1, -1, 1)}}) {
        SCOPED_TRACE(space);
        const auto volume = loaded(folder.write(
            "a.nrrd", kHead + "space: " + space + "\n" + kPlace + "encoding: raw\n\n" + kVoxels));
        ASSERT_TRUE(volume);
        EXPECT_EQ(volume->grid().size, glm::ivec3(4, 3, 2));
        expectPlaced(volume->grid(), placed(signs), 0.0);  // decimal text to double and a sign: exact
        expectVoxels(*volume, ramp<std::int16_t>(24));
        EXPECT_EQ(warningsOf(*volume), "");
    }
}

TEST(Nrrd, WithoutAPatientSpaceTheOrientationIsNotGuessedSilently) {
    const test::TempFolder folder;
    for (const char* space : {"scanner-xyz", "3D-right-handed"}) {
        const auto volume = loaded(folder.write(
            "a.nrrd", kHead + "space: " + space + "\n" + kPlace + "encoding: raw\n\n" + kVoxels));
        ASSERT_TRUE(volume);
        EXPECT_THAT(warningsOf(*volume), HasSubstr(space));
    }
    const auto plain = loaded(folder.write("a.nrrd", kHead + "spacings: 1 2 3\nencoding: raw\n\n" + kVoxels));
    ASSERT_TRUE(plain);
    EXPECT_THAT(warningsOf(*plain), HasSubstr("states no orientation"));
    EXPECT_EQ(spacingMm(plain->grid()), glm::dvec3(1, 2, 3));
}

TEST(Nrrd, CellCentredAxesBeginHalfACellIn) {
    const test::TempFolder folder;
    const auto volume = loaded(folder.write(
        "a.nrrd", kHead +
                      "spacings: 2 2 2\naxis mins: 10 0 -4\ncenterings: cell node cell\nencoding: raw\n\n" +
                      kVoxels));
    ASSERT_TRUE(volume);
    EXPECT_EQ(glm::dvec3(volume->grid().patientFromIndex[3]), glm::dvec3(11, 0, -3));
}

TEST(Nrrd, UnitsOfSpaceBecomeMillimetres) {
    const test::TempFolder folder;
    const auto volume = loaded(folder.write(
        "a.nrrd", kHead + "space: LPS\nspace directions: (0.002,0,0) (0,0.003,0) (0,0,0.004)\n" +
                      "space units: \"m\" \"m\" \"m\"\nspace origin: (0.1,0,0)\nencoding: raw\n\n" +
                      kVoxels));
    ASSERT_TRUE(volume);
    // A decimal fraction times 1000 in double: two roundings of relative 2^-53.
    EXPECT_NEAR(spacingMm(volume->grid()).z, 4.0, 1e-14);
    EXPECT_NEAR(volume->grid().patientFromIndex[3].x, 100.0, 1e-12);
}

TEST(Nrrd, AttachedDetachedRawAndGzipAgree) {
    const test::TempFolder folder;
    const std::string head = kHead + "space: LPS\n" + kPlace;
    folder.write("v.raw", kVoxels);
    folder.write("v.gz", gzipped(kVoxels));
    folder.write("skipped.raw", "two\nlines\n" + std::string(7, 'x') + kVoxels);
    folder.write("end.raw", "anything" + kVoxels);
    const std::vector<std::filesystem::path> files{
        folder.write("a.nrrd", head + "encoding: raw\n\n" + kVoxels),
        folder.write("b.nrrd", head + "encoding: gzip\n\n" + gzipped(kVoxels)),
        folder.write("c.nhdr", head + "encoding: raw\ndata file: v.raw\n"),
        folder.write("d.nhdr", head + "encoding: gz\ndatafile: ./v.gz\n"),
        folder.write("e.nhdr", head + "encoding: raw\nline skip: 2\nbyte skip: 7\ndata file: skipped.raw\n"),
        folder.write("f.nhdr", head + "encoding: raw\nbyte skip: -1\ndata file: end.raw\n"),
        folder.write("g.nrrd", head + "encoding: gzip\nbyte skip: 3\n\n" + gzipped("abc" + kVoxels)),
        folder.write("h.nrrd", head + "encoding: gzip\n\n" + gzipped(kVoxels.substr(0, 11)) +
                                   gzipped(kVoxels.substr(11)))};
    for (const auto& file : files) {
        SCOPED_TRACE(file.filename());
        const auto volume = loaded(file);
        ASSERT_TRUE(volume);
        expectVoxels(*volume, ramp<std::int16_t>(24));
        expectPlaced(volume->grid(), placed({1, 1, 1}), 0.0);
        EXPECT_EQ(warningsOf(*volume), "");
    }
}

template <class T>
void checkType(const test::TempFolder& folder, const std::string& name, VoxelType type) {
    SCOPED_TRACE(name);
    for (const bool big : {false, true}) {
        const auto volume = loaded(folder.write(
            "t.nrrd", "NRRD0001\ntype: " + name + "\ndimension: 3\nsizes: 4 3 2\nspacings: 1 1 1\nendian: " +
                          (big ? "big" : "little") + "\nencoding: raw\n\n" + bytesOf(ramp<T>(24), big)));
        ASSERT_TRUE(volume);
        EXPECT_EQ(volume->type(), type);
        expectVoxels(*volume, ramp<T>(24));
    }
}

TEST(Nrrd, EveryTypeInBothByteOrders) {
    const test::TempFolder folder;
    checkType<std::int8_t>(folder, "signed char", VoxelType::Int8);
    checkType<std::uint8_t>(folder, "uchar", VoxelType::UInt8);
    checkType<std::int16_t>(folder, "short", VoxelType::Int16);
    checkType<std::uint16_t>(folder, "unsigned short", VoxelType::UInt16);
    checkType<std::int32_t>(folder, "int", VoxelType::Int32);
    checkType<std::uint32_t>(folder, "uint32_t", VoxelType::UInt32);
    checkType<float>(folder, "float", VoxelType::Float32);
    checkType<double>(folder, "double", VoxelType::Float64);
}

TEST(Nrrd, WideIntegersAreNarrowedAndTheErrorIsSaid) {
    const test::TempFolder folder;
    const std::string head =
        "NRRD0004\ntype: int64\ndimension: 3\nsizes: 2 1 1\nspacings: 1 1 1\nendian: big\nencoding: raw\n\n";
    const auto exact = loaded(folder.write("a.nrrd", head + bytesOf<std::int64_t>({-3, 70000}, true)));
    ASSERT_TRUE(exact);
    EXPECT_EQ(exact->type(), VoxelType::Int32);
    expectVoxels<std::int32_t>(*exact, {-3, 70000});
    EXPECT_THAT(warningsOf(*exact), HasSubstr("int64 voxels are kept as int32; the worst error is 0"));
    // 2^53 + 1 lies between two doubles.
    const auto rounded =
        loaded(folder.write("b.nrrd", head + bytesOf<std::int64_t>({0, 9007199254740993}, true)));
    ASSERT_TRUE(rounded);
    EXPECT_EQ(rounded->type(), VoxelType::Float64);
    EXPECT_THAT(warningsOf(*rounded), HasSubstr("kept as float64; the worst error is 1 "));
}

TEST(Nrrd, ComponentsMayBeFirstOrLast) {
    const test::TempFolder folder;
    const std::string place = "space: LPS\nencoding: raw\n";
    const auto first = loaded(folder.write(
        "a.nrrd",
        "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 1 2\nkinds: vector domain domain domain\n" + place +
            "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n" +
            bytesOf(ramp<std::uint8_t>(12))));
    ASSERT_TRUE(first);
    EXPECT_EQ(first->components(), 3);
    expectVoxels(*first, ramp<std::uint8_t>(12));
    const auto last = loaded(folder.write(
        "b.nrrd",
        "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 1 2 3\nkinds: domain domain domain RGB-color\n" +
            place + "space directions: (1,0,0) (0,1,0) (0,0,1) none\nspace origin: (0,0,0)\n\n" +
            bytesOf(ramp<std::uint8_t>(12))));
    ASSERT_TRUE(last);
    // Planes of four voxels each: voxel v has v, v + 4, v + 8.
    expectVoxels<std::uint8_t>(*last, {0, 4, 8, 1, 5, 9, 2, 6, 10, 3, 7, 11});
}

TEST(Nrrd, WhatIsCutOffIsRefusedWithNumbers) {
    const test::TempFolder folder;
    const std::string head = kHead + "space: LPS\n" + kPlace;
    expectRefused(folder.write("a.nrrd", head + "encoding: raw\n\n" + kVoxels.substr(0, 40)),
                  ErrorCode::Corrupt,
                  {"4x3x2 voxels x 1 component x 2 bytes (int16) = 48 bytes", "found 40 bytes"});
    const std::string packed = gzipped(bytesOf(ramp<std::int16_t>(24)));
    for (std::size_t length = 0; length < packed.size(); ++length) {
        const Error error =
            refusal(folder.write("b.nrrd", head + "encoding: gzip\n\n" + packed.substr(0, length)));
        EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(ErrorCode::Corrupt))
            << length << ": " << error.text();
    }
    expectRefused(folder.write("c.nrrd", head + "encoding: gzip\n\n" + gzipped(kVoxels.substr(0, 40))),
                  ErrorCode::Corrupt, {"= 48 bytes", "found 40 bytes"});
    expectRefused(folder.write("d.nrrd", kHead + "encoding: raw\n"), ErrorCode::Corrupt, {"cut off"});
    expectRefused(folder.write("e.nhdr", head + "encoding: raw\ndata file: gone.raw\n"), ErrorCode::NotFound,
                  {"gone.raw"});
    std::string damaged = packed;
    damaged[damaged.size() - 6] = static_cast<char>(damaged[damaged.size() - 6] ^ 1);  // in the checksum
    expectRefused(folder.write("f.nrrd", head + "encoding: gzip\n\n" + damaged), ErrorCode::Corrupt,
                  {"damaged"});
}

TEST(Nrrd, SizesAreCheckedBeforeAnythingIsAllocated) {
    const test::TempFolder folder;
    const auto file = [&](const std::string& sizes, const std::string& encoding) {
        return folder.write("a.nrrd", "NRRD0004\ntype: short\ndimension: 3\nsizes: " + sizes +
                                          "\nspacings: 1 1 1\nendian: little\nencoding: " + encoding +
                                          "\n\n" + (encoding == "raw" ? kVoxels : gzipped(kVoxels)));
    };
    expectRefused(file("2000000000 2000000000 2000000000", "raw"), ErrorCode::TooLarge,
                  {"2000000000x2000000000x2000000000"});
    expectRefused(file("1000 1000 5000", "raw"), ErrorCode::Corrupt, {"10000000000 bytes", "found 48 bytes"});
    expectRefused(file("1000 1000 5000", "gzip"), ErrorCode::Corrupt, {"cannot hold more than"});
    expectRefused(file("0 3 2", "raw"), ErrorCode::Corrupt, {"'0' is not a positive integer"});
    expectRefused(file("99999999999 3 2", "raw"), ErrorCode::Corrupt, {"not a positive integer"});
}

TEST(Nrrd, OtherThingsAreRefusedByName) {
    const test::TempFolder folder;
    const std::string end = "encoding: raw\n\n" + kVoxels;
    const auto file = [&](const std::string& text) { return folder.write("a.nrrd", text); };
    expectRefused(file("NRRD0004\ntype: block\ndimension: 3\nsizes: 4 3 2\n" + end), ErrorCode::Unsupported,
                  {"block"});
    expectRefused(file("NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 2\n" + end), ErrorCode::Corrupt,
                  {"endian"});
    expectRefused(file(kHead + "encoding: bzip2\n\n" + kVoxels), ErrorCode::Unsupported, {"bzip2"});
    expectRefused(file(kHead + "sizes: 4 3 2\n" + end), ErrorCode::Corrupt, {"stands twice"});
    expectRefused(file(kHead + "space: LPS\nspace directions: (1,0,0) (0,1,0)\n" + end), ErrorCode::Corrupt,
                  {"2 vectors for 3 axes"});
    expectRefused(file(kHead + "space: LPS\nspace directions: (1,0,0) (2,0,0) (0,0,1)\n" + end),
                  ErrorCode::Corrupt, {"placement"});
    expectRefused(file(kHead + "space: LPS\nspace directions: (1,0,0) (0,nan,0) (0,0,1)\n" + end),
                  ErrorCode::Corrupt, {"placement"});
    expectRefused(
        file("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 24\nkinds: domain domain domain time\n" +
             end),
        ErrorCode::Unsupported, {"24 time steps: not yet"});
    expectRefused(file("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\n" + end), ErrorCode::Unsupported,
                  {"4 axes of space"});
    expectRefused(file("NRRD0004\ntype: float\nendian: little\ndimension: 4\nsizes: 2 2 2 2\nkinds: complex "
                       "domain domain domain\n" +
                       end),
                  ErrorCode::Unsupported, {"complex"});
    expectRefused(file(kHead + "data file: slice%03d.raw 1 2 1\nencoding: raw\n"), ErrorCode::Unsupported,
                  {"several files"});
}

TEST(Nrrd, ReadingCanBeCancelled) {
    const test::TempFolder folder;
    LoadOptions options;
    options.progress = [](double, std::string_view) { return false; };
    const Error error =
        refusal(folder.write("a.nrrd", kHead + "spacings: 1 1 1\nencoding: raw\n\n" + kVoxels), options);
    EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(ErrorCode::Cancelled));
}

}  // namespace
}  // namespace pellucid::io
