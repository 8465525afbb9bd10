// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

using test::bytesOf;
using test::ramp;
using test::zlibbed;
using testing::HasSubstr;

const std::string kHead = "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 4 3 2\n";
const std::string kPlace =
    "TransformMatrix = 0 1 0 0 0 -1 -1 0 0\nOffset = 10 -20 30\nElementSpacing = 2 3 4\n";
const std::string kVoxels = bytesOf(ramp<std::int16_t>(24));

glm::dmat4 placed() {
    // The first three numbers are the direction of the first axis, and so on; spacing scales each.
    return {{0, 2, 0, 0}, {0, 0, -3, 0}, {-4, 0, 0, 0}, {10, -20, 30, 1}};
}

TEST(MetaImage, DirectionsAreKeptInOneFileOrTwoPlainOrCompressed) {
    const test::TempFolder folder;
    folder.write("v.raw", kVoxels);
    folder.write("v.zraw", zlibbed(kVoxels));
    folder.write("h.raw", "header" + kVoxels);
    const std::string head = kHead + kPlace + "ElementType = MET_SHORT\n";
    const std::vector<std::filesystem::path> files{
        folder.write("a.mha", head + "ElementDataFile = LOCAL\n" + kVoxels),
        folder.write("b.mha", head + "CompressedData = True\nElementDataFile = LOCAL\n" + zlibbed(kVoxels)),
        folder.write("c.mhd", head + "ElementDataFile = v.raw\n"),
        folder.write("d.mhd", head + "CompressedData = True\nElementDataFile = v.zraw\n"),
        folder.write("e.mhd", head + "HeaderSize = 6\nElementDataFile = h.raw\n"),
        folder.write("f.mhd", head + "HeaderSize = -1\nElementDataFile = h.raw\n"),
        folder.write("g.mha", head + "BinaryDataByteOrderMSB = True\nElementDataFile = LOCAL\n" +
                                  bytesOf(ramp<std::int16_t>(24), true))};
    for (const auto& file : files) {
        SCOPED_TRACE(file.filename());
        const auto volume = loaded(file);
        ASSERT_TRUE(volume);
        expectPlaced(volume->grid(), placed(), 0.0);  // small integers: exact
        expectVoxels(*volume, ramp<std::int16_t>(24));
        EXPECT_EQ(warningsOf(*volume), "");
    }
}

template <class T>
void checkType(const test::TempFolder& folder, const std::string& name, VoxelType type) {
    SCOPED_TRACE(name);
    const auto volume =
        loaded(folder.write("t.mha", kHead + kPlace + "ElementType = " + name +
                                         "\nElementDataFile = LOCAL\n" + bytesOf(ramp<T>(24))));
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->type(), type);
    expectVoxels(*volume, ramp<T>(24));
}

TEST(MetaImage, EveryTypeAndLongHasFourBytes) {
    const test::TempFolder folder;
    checkType<std::int8_t>(folder, "MET_CHAR", VoxelType::Int8);
    checkType<std::uint8_t>(folder, "MET_UCHAR", VoxelType::UInt8);
    checkType<std::uint16_t>(folder, "MET_USHORT", VoxelType::UInt16);
    checkType<std::int32_t>(folder, "MET_INT", VoxelType::Int32);
    checkType<std::int32_t>(folder, "MET_LONG", VoxelType::Int32);
    checkType<std::uint32_t>(folder, "MET_ULONG", VoxelType::UInt32);
    checkType<float>(folder, "MET_FLOAT", VoxelType::Float32);
    checkType<double>(folder, "MET_DOUBLE", VoxelType::Float64);
}

TEST(MetaImage, ValuesChannelsAndModality) {
    const test::TempFolder folder;
    const auto volume = loaded(folder.write("a.mha",
                                            "NDims = 2\nDimSize = 2 2\nElementSpacing = 1 1\nTransformMatrix "
                                            "= 1 0 0 1\nElementNumberOfChannels = 3\n"
                                            "Modality = MET_MOD_CT\nElementToIntensityFunctionSlope = "
                                            "2\nElementToIntensityFunctionOffset = -1024\n"
                                            "ElementType = MET_UCHAR_ARRAY\nElementDataFile = LOCAL\n" +
                                                bytesOf(ramp<std::uint8_t>(12))));
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->grid().size, glm::ivec3(2, 2, 1));
    EXPECT_EQ(volume->components(), 3);
    EXPECT_EQ(volume->info().modality, "CT");
    EXPECT_EQ(volume->physical({1, 1, 0}, 2), 11 * 2 - 1024);
}

TEST(MetaImage, AContradictingAnatomicalOrientationIsSaid) {
    const test::TempFolder folder;
    const std::string end = "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" + kVoxels;
    // "From" letters: the axes of kPlace go to P, I and R, so they come from A, S and L.
    EXPECT_EQ(
        warningsOf(*loaded(folder.write("a.mha", kHead + kPlace + "AnatomicalOrientation = ASL\n" + end))),
        "");
    EXPECT_THAT(
        warningsOf(*loaded(folder.write("b.mha", kHead + kPlace + "AnatomicalOrientation = RAI\n" + end))),
        HasSubstr("RAI"));
    EXPECT_THAT(warningsOf(*loaded(folder.write("c.mha", kHead + "ElementSpacing = 1 1 1\n" + end))),
                HasSubstr("no TransformMatrix"));
}

TEST(MetaImage, RefusalsSayWhatAndWhere) {
    const test::TempFolder folder;
    const std::string head = kHead + kPlace + "ElementType = MET_SHORT\n";
    const auto file = [&](const std::string& text) { return folder.write("a.mha", text); };
    expectRefused(file(head + "ElementDataFile = LOCAL\n" + kVoxels.substr(1)), ErrorCode::Corrupt,
                  {"= 48 bytes", "found 47 bytes"});
    const std::string packed = zlibbed(kVoxels);
    for (std::size_t length = 0; length < packed.size(); ++length) {
        refusal(file(head + "CompressedData = True\nElementDataFile = LOCAL\n" + packed.substr(0, length)));
    }
    expectRefused(file(head), ErrorCode::Corrupt, {"no ElementDataFile"});
    expectRefused(file(head + "ElementDataFile = LIST\na.raw\n"), ErrorCode::Unsupported, {"several files"});
    expectRefused(file(head + "ElementDataFile = gone.raw\n"), ErrorCode::NotFound, {"gone.raw"});
    expectRefused(file(kHead + "ElementType = MET_STRING\nElementDataFile = LOCAL\n"), ErrorCode::Unsupported,
                  {"MET_STRING"});
    expectRefused(file("ObjectType = Tube\nNDims = 3\nElementDataFile = LOCAL\n"), ErrorCode::Unsupported,
                  {"Tube"});
    expectRefused(file("NDims = 4\nDimSize = 2 2 2 5\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"),
                  ErrorCode::Unsupported, {"4D", "2 2 2 5"});
    expectRefused(file("NDims = 3\nDimSize = 2 -2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"),
                  ErrorCode::Corrupt, {"-2"});
    expectRefused(file(kHead +
                       "TransformMatrix = 1 0 0 0 1 0 0 0 0\nElementSpacing = 1 1 1\nElementType = "
                       "MET_SHORT\nElementDataFile = LOCAL\n" +
                       kVoxels),
                  ErrorCode::Corrupt, {"placement"});
}

}  // namespace
}  // namespace pellucid::io
