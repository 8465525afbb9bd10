// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/resource_store.h"

#include <gtest/gtest.h>

#include "tests/gl/gl_fixture.h"

namespace pellucid::renderer {
namespace {

using ResourceStoreTest = test::GlTest;

VolumePtr emptyVolume() {
    return Volume::make(axisAlignedGrid({9, 8, 7}), VoxelType::UInt8, 1, std::vector<std::byte>(9 * 8 * 7))
        .value();
}

/// All that the store makes of a volume.
std::vector<GLuint> makeAll(ResourceStore& store, const VolumePtr& volume) {
    const auto texture = store.volume(volume, 0, {});
    const auto field = store.field(volume, 0);
    const auto importance = store.importance(volume, 0, {});
    const auto leaps = store.leaps(volume, 0, Filter::Trilinear, **texture, {{0.0, 1.0}}, {});
    return {(*texture)->texture.id(), (*field)->texture.id(), (*importance)->id(),
            store.leapField(**leaps).id()};
}

TEST_F(ResourceStoreTest, WhatWasMadeOfAVolumeGoesWithIt) {
    ResourceStore store;
    VolumePtr closed = emptyVolume();
    const VolumePtr open = emptyVolume();
    const auto ofClosed = makeAll(store, closed);
    const auto ofOpen = makeAll(store, open);
    closed.reset();
    store.dropGone();
    for (const GLuint texture : ofClosed) EXPECT_FALSE(glIsTexture(texture));
    for (const GLuint texture : ofOpen) EXPECT_TRUE(glIsTexture(texture));
    EXPECT_EQ(makeAll(store, open), ofOpen);
    EXPECT_EQ(store.counts.volumeUploads, 2);
}

/// Lit with a texture of gradients, which is four times its volume; then another volume without light.
TEST_F(ResourceStoreTest, APictureOfAnotherVolumeHoldsNothingOfTheOneBefore) {
    auto renderer = Renderer::inCurrentContext().value();
    VolumePtr volume = emptyVolume();
    Scene scene;
    scene.picture.size = {8, 8};
    scene.lights.emplace({Light{}});
    const auto texturesAlive = [] {
        int count = 0;
        for (GLuint id = 1; id < 1000; ++id) count += glIsTexture(id) ? 1 : 0;
        return count;
    };
    ASSERT_TRUE(renderer.render(scene, {volume}));
    EXPECT_EQ(renderer.workCounts().fieldTextures, 1);
    const int one = texturesAlive();
    volume = emptyVolume();
    scene.lights->clear();
    ASSERT_TRUE(renderer.render(scene, {volume}));
    EXPECT_EQ(renderer.workCounts().volumeUploads, 2);
    EXPECT_LT(texturesAlive(), one) << "the first volume's gradients are still there";
}

}  // namespace
}  // namespace pellucid::renderer
