// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/field_texture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "renderer/resources/volume_texture.h"
#include "tests/gl/gl_fixture.h"

namespace pellucid::renderer {
namespace {

using FieldTextureTest = test::GlTest;

/// Uniform random stored values in [lo, hi].
template <class T>
VolumePtr randomVolume(glm::ivec3 size, VoxelType type, double lo, double hi, int components = 1) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(lo, hi);
    std::vector<std::byte> bytes(static_cast<std::size_t>(size.x * size.y * size.z * components) * sizeof(T));
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(T)) {
        const T value = static_cast<T>(std::round(uniform(random)));
        std::memcpy(bytes.data() + i, &value, sizeof value);
    }
    return Volume::make(axisAlignedGrid(size), type, components, std::move(bytes)).value();
}

FieldTexture made(const Volume& volume, int component, double budgetMs) {
    auto field = allocateField(layoutField(factsOf(volume, component)));
    EXPECT_TRUE(field) << field.error().text();
    while (!field->isComplete()) {
        const int before = field->layersMade;
        EXPECT_TRUE(makeField(*field, volume, component, budgetMs));
        EXPECT_GT(field->layersMade, before);
        if (field->layersMade <= before) break;
    }
    return std::move(*field);
}

std::vector<glm::vec4> texelsOf(const FieldTexture& field) {
    std::vector<glm::vec4> texels(
        static_cast<std::size_t>(field.layout.size.x * field.layout.size.y * field.layout.size.z));
    glGetTextureImage(field.texture.id(), 0, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(texels.size() * sizeof(glm::vec4)), texels.data());
    return texels;
}

struct Worst {
    double difference = 0.0;  ///< Of a component, stored values a voxel.
    double value = 0.0;       ///< Stored values.
};

/// Every texel against differences of Volume::stored over indices clamped to the volume.
Worst worstOf(const Volume& volume, int component, double budgetMs = 1e9) {
    const FieldTexture field = made(volume, component, budgetMs);
    const auto texels = texelsOf(field);
    const auto map = storedFromTexel(volume.type(), volume.storedRange(component));
    const glm::dvec2 fromTexel = field.layout.differenceFromTexel();
    const glm::ivec3 size = field.layout.size;
    EXPECT_EQ(size, volume.grid().size + 2);
    const auto stored = [&](glm::ivec3 i) {
        return volume.stored(glm::clamp(i, glm::ivec3(0), volume.grid().size - 1), component);
    };
    Worst worst;
    std::size_t at = 0;
    for (int z = -1; z < size.z - 1; ++z)
        for (int y = -1; y < size.y - 1; ++y)
            for (int x = -1; x < size.x - 1; ++x, ++at) {
                const glm::ivec3 i(x, y, z);
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 step(0);
                    step[axis] = 1;
                    const double expected = 0.5 * (stored(i + step) - stored(i - step));
                    // In float, as the shader does: the middle is exactly no difference.
                    const float apart = texels[at][axis] - static_cast<float>(fromTexel.y);
                    const double found = static_cast<double>(apart) * fromTexel.x * map.scale;
                    worst.difference = std::max(worst.difference, std::abs(found - expected));
                }
                const double value = static_cast<double>(texels[at].a) * map.scale + map.offset;
                worst.value = std::max(worst.value, std::abs(value - stored(i)));
            }
    return worst;
}

TEST_F(FieldTextureTest, HoldsTheDifferencesAndValuesOfEveryVoxelAndBeyondTheBorder) {
    // A texel is read as float: half an ulp of 1, 2^-25, of 65535 texels is 0.002 texels, twice with that of
    // the middle; of 1/8 (4096 values), 1/128 (256 values) or 1 stored value a texel, over two voxels.
    const double texel = 0.5 * 2.0 * std::ldexp(65535.0, -25);
    const double half = std::ldexp(65535.0, -24);
    const glm::ivec3 size(7, 5, 6);
    const Worst ct = worstOf(*randomVolume<std::int16_t>(size, VoxelType::Int16, -1024, 3071), 0);
    EXPECT_LE(ct.difference, texel / 7.0);
    EXPECT_LE(ct.value, half);
    const Worst bytes = worstOf(*randomVolume<std::uint8_t>(size, VoxelType::UInt8, 0, 255), 0);
    EXPECT_LE(bytes.difference, texel / 127.0);
    const Worst half16 = worstOf(*randomVolume<std::uint16_t>(size, VoxelType::UInt16, 3, 32770), 0);
    EXPECT_LE(half16.difference, texel);
    const Worst flat = worstOf(*randomVolume<std::int8_t>(size, VoxelType::Int8, 7, 7), 0);
    EXPECT_EQ(flat.difference, 0.0);
}

TEST_F(FieldTextureTest, DifferencesOfLargeRangesKeepToTheirBound) {
    const VolumePtr volume = randomVolume<std::uint16_t>({9, 8, 7}, VoxelType::UInt16, 0, 65535);
    const FieldLayout layout = layoutField(factsOf(*volume, 0));
    const Worst worst = worstOf(*volume, 0);
    EXPECT_GT(layout.worstError(), 0.0);
    EXPECT_LE(worst.difference, layout.worstError() * 65535.0 * 1.01);
    EXPECT_GT(worst.difference, layout.worstError() * 65535.0 * 0.5) << "the bound is sharp";
}

TEST_F(FieldTextureTest, OtherTypesAreFloats) {
    // Values and differences are floats of values over the range: an ulp of 1 of the range.
    const double ulp = 2e6 * std::ldexp(1.0, -23);
    const Worst ints = worstOf(*randomVolume<std::int32_t>({5, 6, 7}, VoxelType::Int32, -1e6, 1e6), 0);
    EXPECT_LE(ints.difference, ulp);
    EXPECT_LE(ints.value, ulp);
    EXPECT_LE(worstOf(*randomVolume<double>({5, 6, 7}, VoxelType::Float64, -1e6, 1e6), 0).difference, ulp);
}

TEST_F(FieldTextureTest, ShapesOfOneVoxelAndSeveralComponents) {
    const double texel = std::ldexp(65535.0, -24);
    for (const glm::ivec3 size :
         {glm::ivec3(1, 1, 1), glm::ivec3(1, 9, 2), glm::ivec3(2, 1, 9), glm::ivec3(70, 1, 1)})
        EXPECT_LE(worstOf(*randomVolume<std::int16_t>(size, VoxelType::Int16, 0, 1000), 0).difference, texel);
    for (int component = 0; component < 3; ++component)
        EXPECT_LE(worstOf(*randomVolume<std::uint8_t>({6, 4, 5}, VoxelType::UInt8, 0, 255, 3), component)
                      .difference,
                  texel);
}

TEST_F(FieldTextureTest, IsTheSameMadeInParts) {
    // 1.2 million texels: two slabs.
    const VolumePtr volume = randomVolume<std::uint8_t>({126, 98, 93}, VoxelType::UInt8, 0, 255);
    auto part = allocateField(layoutField(factsOf(*volume, 0))).value();
    ASSERT_TRUE(makeField(part, *volume, 0, 0.0));
    EXPECT_FALSE(part.isComplete());
    EXPECT_GT(part.layersMade, 0);
    EXPECT_LE(worstOf(*volume, 0, 0.0).difference, std::ldexp(65535.0, -24));
}

TEST_F(FieldTextureTest, CanBeCancelled) {
    const VolumePtr volume = randomVolume<std::uint8_t>({4, 4, 4}, VoxelType::UInt8, 0, 255);
    auto field = allocateField(layoutField(factsOf(*volume, 0))).value();
    const auto stopped = makeField(field, *volume, 0, 1e9, [](double, std::string_view) { return false; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(field.layersMade, 0);
}

}  // namespace
}  // namespace pellucid::renderer
