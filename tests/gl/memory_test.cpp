// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What a process takes at its peak, beside what the plan says beforehand. Linux tells it in /proc.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>

#include "renderer/renderer.h"
#include "tests/gl/gl_fixture.h"

namespace pellucid::renderer {
namespace {

/// A number of bytes from /proc/self/status; 0 where there is none.
double statusBytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    double kilobytes = 0.0;
    for (std::string word; status >> word;)
        if (word == key + ":") status >> kilobytes;
    return 1024.0 * kilobytes;
}

/// From now on the peak counts anew; false where the system does not do that.
bool forgetPeak() {
    std::ofstream clear("/proc/self/clear_refs");
    return static_cast<bool>(clear << "5" << std::flush);
}

VolumePtr largeVolume(glm::ivec3 size) {
    std::vector<std::byte> bytes(2 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                                 static_cast<std::size_t>(size.z));
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
        const auto value = static_cast<std::int16_t>(i / 20000 % 1500);
        std::memcpy(bytes.data() + i, &value, 2);
    }
    return Volume::make(axisAlignedGrid(size), VoxelType::Int16, 1, std::move(bytes), {1.0, 0.0, "HU"})
        .value();
}

using MemoryTest = test::GlTest;

TEST_F(MemoryTest, ThePeakIsWhatThePlanSays) {
    auto renderer = Renderer::headless().value();
    Scene scene;
    scene.picture.size = {1024, 768};
    scene.quality.stepVoxels = 8.0;
    scene.lights.emplace();  // A light may bring a texture of gradients, four times the volume.
    // The driver's compiler is started before, and what it keeps.
    ASSERT_TRUE(renderer.render(scene, {largeVolume({64, 64, 64})}));
    const double before = statusBytes("VmRSS");
    if (before == 0.0 || !forgetPeak()) GTEST_SKIP() << "the system does not tell";
    const VolumePtr volume = largeVolume({512, 512, 256});
    const auto frame = renderer.render(scene, {volume});
    ASSERT_TRUE(frame) << frame.error().text();
    const double taken = statusBytes("VmHWM") - before;
    const double stated = static_cast<double>(frame->plan.mainBytes);
    const double onGpu = renderer.deviceInfo().software ? static_cast<double>(frame->plan.totalBytes) : 0.0;
    // The small volume's things may be in use again, the compiler makes another program: 24 MB.
    EXPECT_NEAR(taken, stated + onGpu, 24e6);
    if (renderer.deviceInfo().software) {
        EXPECT_LT(taken, 2.4 * static_cast<double>(frame->plan.volumeBytes));
    }
}

}  // namespace
}  // namespace pellucid::renderer
