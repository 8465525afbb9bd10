// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

using test::bytesOf;
using test::gzipped;
using test::ramp;
using testing::HasSubstr;

const std::string kVoxels = bytesOf(ramp<std::int16_t>(24), true);
constexpr const char* kSidecar =
    R"({"size": [4, 3, 2], "type": "int16", "endianness": "big", "spacingMm": [2, 3, 4.5],
    "headerBytes": 5, "slope": 0.5, "intercept": -1024, "unit": "HU", "components": 1})";

TEST(Raw, ASidecarSaysHowTheVoxelsLie) {
    const test::TempFolder folder;
    folder.write("v.raw.json", kSidecar);
    folder.write("w.json", kSidecar);
    folder.write("z.raw.gz.json", kSidecar);
    for (const auto& file :
         {folder.write("v.raw", "12345" + kVoxels), folder.write("w.dat", "12345" + kVoxels),
          folder.write("z.raw.gz", gzipped("12345" + kVoxels))}) {
        SCOPED_TRACE(file.filename());
        const auto volume = loaded(file);
        ASSERT_TRUE(volume);
        expectVoxels(*volume, ramp<std::int16_t>(24));
        EXPECT_EQ(spacingMm(volume->grid()), glm::dvec3(2, 3, 4.5));
        EXPECT_EQ(volume->mapping(), (ValueMapping{0.5, -1024, "HU"}));
        EXPECT_THAT(warningsOf(*volume), HasSubstr("no orientation"));
    }
}

TEST(Raw, OptionsGoBeforeWhatTheBytesLookLike) {
    const test::TempFolder folder;
    LoadOptions options;
    options.raw = RawLayout{};
    options.raw->size = {4, 2, 1};
    const auto volume = loaded(folder.write("a.nrrd", "NRRD0004"), options);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->stored({0, 0, 0}), 'N');
}

TEST(Raw, AWrongSizeIsRefusedWithTheArithmetic) {
    const test::TempFolder folder;
    folder.write("v.raw.json", kSidecar);
    for (const auto& [bytes, found] :
         {std::pair{kVoxels, "found 48"}, std::pair{"123456" + kVoxels, "found 54"}}) {
        expectRefused(folder.write("v.raw", bytes), ErrorCode::Corrupt,
                      {"5 header bytes + 4x3x2 voxels x 1 component x 2 bytes (int16) = 53 bytes", found});
    }
    folder.write("z.gz.json", kSidecar);
    expectRefused(folder.write("z.gz", gzipped("1234567" + kVoxels)), ErrorCode::Corrupt,
                  {"= 53 bytes after decompression, found 55"});
    expectRefused(folder.write("z.gz", gzipped(kVoxels)), ErrorCode::Corrupt, {"found 43 bytes"});
}

TEST(Raw, SidecarErrorsNameThePointerWhatWasFoundAndWhatIsAllowed) {
    const test::TempFolder folder;
    folder.write("v.raw", kVoxels);
    const auto expect = [&](const std::string& text, ErrorCode code, const std::vector<std::string>& words) {
        SCOPED_TRACE(text);
        folder.write("v.raw.json", text);
        const Error error = refusal(folder.path() / "v.raw");
        EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(code)) << error.text();
        for (const std::string& word : words) EXPECT_THAT(error.text(), HasSubstr(word));
        EXPECT_THAT(error.text(), HasSubstr("v.raw.json"));
    };
    const auto invalid = ErrorCode::InvalidArgument;
    expect(R"({"size": [4, 3], "type": "int16"})", invalid,
           {"/size: found [4,3], allowed is three positive integers"});
    expect(R"({"size": [4, 3, 0], "type": "int16"})", invalid, {"/size: found [4,3,0]"});
    expect(R"({"size": [4, 3, 2.5], "type": "int16"})", invalid, {"/size: found [4,3,2.5]"});
    expect(R"({"size": [4, 3, 2], "type": "short"})", invalid,
           {"/type: found \"short\", allowed is int8, uint8"});
    expect(R"({"size": [4, 3, 2], "type": "int16", "spacingMm": [1, 0, 1]})", invalid, {"/spacingMm"});
    expect(R"({"size": [4, 3, 2], "type": "int16", "components": 5})", invalid, {"/components: found 5"});
    expect(R"({"size": [4, 3, 2], "type": "int16", "slope": 0})", invalid, {"/slope: found 0"});
    expect(R"({"size": [4, 3, 2], "type": "int16", "headerBytes": -1})", invalid, {"/headerBytes: found -1"});
    expect(R"({"size": [4, 3, 2], "type": "int16", "endianness": "middle"})", invalid,
           {"/endianness: found \"middle\""});
    expect(R"({"size": [4, 3, 2], "type": "int16", "spacing": [1, 1, 1]})", invalid,
           {"/spacing: not a known member", "spacingMm"});
    expect(R"({"size": [4, 3, 2]})", invalid, {"/type: missing"});
    expect(R"({"type": "int16"})", invalid, {"/size: missing"});
    expect(R"([1])", invalid, {"found no object"});
    expect("{\n\"size\": [4, 3 2]}", ErrorCode::Corrupt, {"line 2"});
}

TEST(Raw, LayoutsMadeInCodeAreChecked) {
    const test::TempFolder folder;
    const auto file = folder.write("v", kVoxels);
    const auto with = [&](auto&& change) {
        LoadOptions options;
        options.raw = RawLayout{};
        options.raw->size = {4, 3, 2};
        options.raw->type = "int16";
        change(*options.raw);
        return loadVolume({file}, options);
    };
    EXPECT_TRUE(with([](RawLayout&) {}));
    EXPECT_FALSE(with([](RawLayout& raw) { raw.type = "int12"; }));
    EXPECT_FALSE(with([](RawLayout& raw) { raw.size.y = 0; }));
    EXPECT_FALSE(with([](RawLayout& raw) { raw.components = 0; }));
    EXPECT_FALSE(with([](RawLayout& raw) { raw.spacingMm.x = -1; }));
    EXPECT_FALSE(with([](RawLayout& raw) { raw.slope = 0; }));
    EXPECT_FALSE(with([](RawLayout& raw) { raw.headerBytes = UINT64_MAX; }));
}

TEST(Load, WhatIsNotKnownIsRefusedWithAWayOn) {
    const test::TempFolder folder;
    expectRefused(folder.write("a.bin", "some bytes"), ErrorCode::Unsupported, {"a.bin.json"});
    expectRefused(folder.write("empty", ""), ErrorCode::Corrupt, {"empty"});
    expectRefused(folder.write("a.png", "\x89PNG...."), ErrorCode::Unsupported, {"a picture"});
    expectRefused(folder.write("s.json", R"({"pellucid": 1})"), ErrorCode::Unsupported, {"scene"});
    expectRefused(folder.path() / "gone", ErrorCode::NotFound, {"does not exist"});
    expectRefused("/dev/zero", ErrorCode::Unreadable, {"not a regular file"});
    folder.write("v.mhd", "x");
    expectRefused(folder.write("v.zraw", "xx"), ErrorCode::Unsupported, {"open v.mhd instead"});
    EXPECT_FALSE(loadVolume({}));
    const auto two = loadVolume({folder.write("a.nrrd", "NRRD0004"), folder.write("b.nrrd", "NRRD0004")});
    ASSERT_FALSE(two);
    EXPECT_THAT(two.error().text(), HasSubstr("one file at a time"));
}

}  // namespace
}  // namespace pellucid::io
