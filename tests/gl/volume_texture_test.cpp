// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/volume_texture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/gl/gl_fixture.h"

namespace pellucid::renderer {
namespace {

using VolumeTextureTest = test::GlTest;

template <class T>
VolumePtr volumeOf(glm::ivec3 size, VoxelType type, const std::vector<T>& values, int components = 1) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return Volume::make(axisAlignedGrid(size), type, components, std::move(bytes), {2.0, -3.0, ""}).value();
}

/// Physical values read back from the texture.
std::vector<double> readBack(const VolumeTexture& texture, std::size_t count) {
    std::vector<float> texels(count);
    // 16-bit texels come back as float exactly: value / 65535, and the driver's division is correctly rounded
    // to 2^-24.
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.texture.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(count * sizeof(float)),
                      texels.data());
    std::vector<double> values;
    for (const float u : texels)
        values.push_back(static_cast<double>(u) * texture.physicalPerTexel() + texture.physicalAtZero());
    return values;
}

template <class T>
void expectExact(VoxelType type, double tolerance) {
    // Odd sizes, so that row padding would show.
    const glm::ivec3 size{3, 5, 7};
    std::vector<T> values(105);
    const double lo = static_cast<double>(std::numeric_limits<T>::lowest()),
                 hi = static_cast<double>(std::numeric_limits<T>::max());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<T>(lo + (hi - lo) * static_cast<double>(i) / 104.0);
    const auto volume = volumeOf(size, type, values);
    const auto texture = uploadVolume(*volume, 0);
    ASSERT_TRUE(texture) << texture.error().text();
    const auto read = readBack(*texture, values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(read[i], 2.0 * static_cast<double>(values[i]) - 3.0, tolerance * (hi - lo))
            << name(type) << " " << i;
}

TEST_F(VolumeTextureTest, ReadsBackWhatWasUploaded) {
    // u is float: half an ulp of 1 is 2^-25 of the type's range, doubled by the slope of 2.
    const double half = 2.0 * std::ldexp(1.0, -24);
    expectExact<std::uint8_t>(VoxelType::UInt8, half);
    expectExact<std::int8_t>(VoxelType::Int8, half);
    expectExact<std::uint16_t>(VoxelType::UInt16, half);
    expectExact<std::int16_t>(VoxelType::Int16, half);
    expectExact<std::int32_t>(VoxelType::Int32, half);
    expectExact<std::uint32_t>(VoxelType::UInt32, half);
}

TEST_F(VolumeTextureTest, FloatsKeepTheirPrecisionRelativeToTheRange) {
    const std::vector<double> values{-1e9, 0.0, 1.0, 1e-300, 1e9, 123456.789};
    const auto texture = uploadVolume(*volumeOf({6, 1, 1}, VoxelType::Float64, values), 0);
    ASSERT_TRUE(texture);
    const auto read = readBack(*texture, 6);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(read[i], 2.0 * values[i] - 3.0, 2.0 * 2e9 * std::ldexp(1.0, -24));
}

TEST_F(VolumeTextureTest, ValuesThatAreNotFiniteBecomeTheSmallestFiniteOne) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const auto texture =
        uploadVolume(*volumeOf<float>({5, 1, 1}, VoxelType::Float32, {nan, 4.0f, inf, 8.0f, -inf}), 0);
    ASSERT_TRUE(texture);
    EXPECT_THAT(readBack(*texture, 5), testing::ElementsAre(5.0, 5.0, 5.0, 13.0, 5.0));
}

TEST_F(VolumeTextureTest, PicksTheComponent) {
    const auto texture =
        uploadVolume(*volumeOf<std::uint8_t>({2, 1, 1}, VoxelType::UInt8, {1, 2, 3, 4, 5, 6}, 3), 1);
    ASSERT_TRUE(texture);
    const auto read = readBack(*texture, 2);
    EXPECT_NEAR(read[0], 2.0 * 2 - 3, 1e-4);
    EXPECT_NEAR(read[1], 2.0 * 5 - 3, 1e-4);
}

TEST_F(VolumeTextureTest, AConstantVolumeHasAFiniteMap) {
    const auto texture = uploadVolume(*volumeOf<float>({1, 1, 1}, VoxelType::Float32, {7.5f}), 0);
    ASSERT_TRUE(texture);
    EXPECT_THAT(readBack(*texture, 1), testing::ElementsAre(12.0));
    EXPECT_EQ(texture->texelExtent, 0.0);
}

TEST_F(VolumeTextureTest, AVolumeBeyondTheDriversLimitIsRefusedBeforeMemoryIsTaken) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &limit);
    std::vector<std::uint8_t> row(static_cast<std::size_t>(limit) + 1, 1);
    const auto texture = uploadVolume(*volumeOf({limit + 1, 1, 1}, VoxelType::UInt8, row), 0);
    ASSERT_FALSE(texture);
    EXPECT_EQ(texture.error().code, ErrorCode::TooLarge);
    EXPECT_THAT(texture.error().text(), testing::HasSubstr(std::to_string(limit + 1)));
    (void)takeGlErrors();  // the proxy's own complaint, if the driver makes one
}

}  // namespace
}  // namespace pellucid::renderer
