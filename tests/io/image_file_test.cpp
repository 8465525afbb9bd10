// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "io/atomic_file.h"
#include "tests/support/file_bytes.h"

namespace pellucid::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Image8 picture(int channels) {
    Image8 image{{5, 3}, channels, {}};
    for (int i = 0; i < 5 * 3 * channels; ++i) image.bytes.push_back(static_cast<std::uint8_t>(i * 37));
    return image;
}

/// Values that a lossy path would change: tiny, huge, negative zero, infinite, not a number.
ImageF floats() {
    ImageF image{{3, 2}, std::vector<glm::vec4>(6)};
    const float inf = std::numeric_limits<float>::infinity();
    image.pixels[0] = {1e-42f, -0.0f, 3.4e38f, 1.0f};
    image.pixels[1] = {inf, -inf, std::nanf(""), 1.0f};
    for (std::size_t i = 2; i < 6; ++i)
        image.pixels[i] = glm::vec4(0.1f * static_cast<float>(i), 1.0f / 3.0f, -2.5f, 1.0f);
    return image;
}

bool sameBits(const ImageF& a, const ImageF& b) {
    return a.size == b.size && a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec4)) == 0;
}

TEST(ImageFile, PngKeepsEveryByte) {
    const test::TempFolder folder;
    for (const int channels : {3, 4}) {
        const auto file = folder.path() / "a.png";
        ASSERT_TRUE(writePng(file, picture(channels)));
        const auto back = readPng(file);
        ASSERT_TRUE(back) << back.error().text();
        EXPECT_EQ(*back, picture(channels));
    }
}

TEST(ImageFile, FloatFormatsKeepEveryBit) {
    const test::TempFolder folder;
    ASSERT_TRUE(writeNpy(folder.path() / "a.npy", floats()));
    const auto npy = readImage(folder.path() / "a.npy");
    ASSERT_TRUE(npy) << npy.error().text();
    EXPECT_TRUE(sameBits(*npy, floats()));

    ASSERT_TRUE(writePfm(folder.path() / "a.pfm", floats()));
    const auto pfm = readImage(folder.path() / "a.pfm");
    ASSERT_TRUE(pfm) << pfm.error().text();
    EXPECT_TRUE(sameBits(*pfm, floats()));  // alpha is 1 in the picture, so nothing is lost
}

TEST(ImageFile, NpyIsWhatNumpyWrites) {
    // numpy.save of numpy.zeros((2, 3, 4), "<f4"): 128 bytes of header.
    std::string expected("\x93NUMPY\x01\x00\x76\x00", 10);
    expected += "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 4), }";
    expected.resize(127, ' ');
    expected += '\n';
    expected.resize(128 + 2 * 3 * 4 * 4, '\0');
    const test::TempFolder folder;
    ASSERT_TRUE(
        writeNpy(folder.path() / "a.npy", ImageF{{3, 2}, std::vector<glm::vec4>(6, glm::vec4(0.0f))}));
    EXPECT_EQ(test::readBytes(folder.path() / "a.npy"), expected);
}

TEST(ImageFile, PfmBeginsWithTheBottomRow) {
    const test::TempFolder folder;
    ImageF image{{1, 2}, {glm::vec4(1, 2, 3, 1), glm::vec4(4, 5, 6, 1)}};
    ASSERT_TRUE(writePfm(folder.path() / "a.pfm", image));
    EXPECT_EQ(test::readBytes(folder.path() / "a.pfm"),
              "PF\n1 2\n-1.0\n" + test::bytesOf<float>({4, 5, 6, 1, 2, 3}));
}

TEST(ImageFile, BigEndianAndGreyPfmAreRead) {
    const test::TempFolder folder;
    const auto grey =
        readImage(folder.write("g.pfm", "Pf\n2 1\n1.0\n" + test::bytesOf<float>({0.25f, 0.5f}, true)));
    ASSERT_TRUE(grey) << grey.error().text();
    EXPECT_EQ(grey->at(1, 0), glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
}

TEST(ImageFile, CutOffFilesAreRefused) {
    const test::TempFolder folder;
    ASSERT_TRUE(writePng(folder.path() / "a.png", picture(3)));
    ASSERT_TRUE(writeNpy(folder.path() / "a.npy", floats()));
    ASSERT_TRUE(writePfm(folder.path() / "a.pfm", floats()));
    for (const char* name : {"a.png", "a.npy", "a.pfm"}) {
        const std::string whole = test::readBytes(folder.path() / name);
        for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
            // libpng accepts a file whose last chunk (IEND, 12 bytes, no data) is cut off.
            if (std::string(name) == "a.png" && length + 12 >= whole.size()) continue;
            const auto file = folder.write("cut", whole.substr(0, length));
            EXPECT_FALSE(readImage(file)) << name << " of " << length << " bytes";
        }
    }
    EXPECT_THAT(readImage(folder.write("cut.npy", test::readBytes(folder.path() / "a.npy").substr(0, 200)))
                    .error()
                    .text(),
                HasSubstr("expected 2x3x4 float32 = 96 bytes after the header, found 72"));
}

TEST(ImageFile, OtherFilesAreNamed) {
    const test::TempFolder folder;
    EXPECT_THAT(readImage(folder.write("a.txt", "hello")).error().text(), HasSubstr("a.txt"));
    EXPECT_FALSE(readImage(folder.path() / "gone.png"));
    EXPECT_FALSE(writePng(folder.path() / "b.png", Image8{{4, 4}, 3, {1, 2, 3}}));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.png"));
}

std::span<const std::byte> asBytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

TEST(AtomicFile, ReplacesWholeAndLeavesNothingBeside) {
    const test::TempFolder folder;
    const auto file = folder.write("a.txt", "old and longer");
    ASSERT_TRUE(writeFile(file, asBytes("new")));
    EXPECT_EQ(test::readBytes(file), "new");
    EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, FailureLeavesNothing) {
    const test::TempFolder folder;
    EXPECT_FALSE(writeFile(folder.path() / "gone" / "a.txt", asBytes("x")));
    std::filesystem::create_directory(folder.path() / "dir");
    const auto written = writeFile(folder.path() / "dir", asBytes("x"));
    ASSERT_FALSE(written);
    EXPECT_EQ(static_cast<int>(written.error().code), static_cast<int>(ErrorCode::WriteFailed));
    EXPECT_THAT(folder.names(), ElementsAre("dir"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "dir"));
}

TEST(AtomicFile, LinksAndDevicesStayWhatTheyAre) {
    const test::TempFolder folder;
    folder.write("real.txt", "old");
    std::filesystem::create_symlink("real.txt", folder.path() / "link.txt");
    ASSERT_TRUE(writeFile(folder.path() / "link.txt", asBytes("new")));
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.txt"));
    EXPECT_EQ(test::readBytes(folder.path() / "real.txt"), "new");
    ASSERT_TRUE(writeFile("/dev/null", asBytes("x")));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, ReadingIsLimited) {
    const test::TempFolder folder;
    const auto file = folder.write("a", "0123456789");
    EXPECT_TRUE(readFile(file, 10));
    const auto refused = readFile(file, 9);
    ASSERT_FALSE(refused);
    EXPECT_EQ(static_cast<int>(refused.error().code), static_cast<int>(ErrorCode::TooLarge));
    EXPECT_THAT(readFile("/dev/zero", 1 << 20).error().text(), HasSubstr("more than"));
}

}  // namespace
}  // namespace pellucid::io
