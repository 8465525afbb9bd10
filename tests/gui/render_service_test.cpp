// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/render_service.h"

#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

using app::RenderService;

class RenderServiceTest : public ::testing::Test {
protected:
    RenderServiceTest() {
        QObject::connect(&service, &RenderService::replied,
                         [this](const RenderService::Reply& reply) { replies.push_back(reply); });
    }
    std::uint64_t ask(int channel, RenderService::Priority priority, glm::ivec2 size,
                      double stepVoxels = 0.5) {
        Scene scene = scan.scene;
        scene.picture.size = size;
        scene.quality.stepVoxels = stepVoxels;
        return service.request({channel, scene, scan.volumes, priority, false});
    }
    [[nodiscard]] bool waitReplies(std::size_t count) {
        return waitFor([&] { return replies.size() >= count; });
    }

    app::OpenedScan scan = smallScan();
    RenderService service;
    std::vector<RenderService::Reply> replies;
};

TEST_F(RenderServiceTest, NamesItsDevice) {
    QString device;
    RenderService another;
    QObject::connect(&another, &RenderService::started, [&](const QString& name, const QString& error) {
        device = name;
        EXPECT_TRUE(error.isEmpty()) << error.toStdString();
    });
    EXPECT_TRUE(waitFor([&] { return !device.isEmpty(); }));
}

TEST_F(RenderServiceTest, OfSeveralWaitingRequestsOfAChannelTheNewestIsAnswered) {
    // The first may have begun already; of the rest only the last has an answer.
    std::uint64_t last = 0;
    for (int i = 0; i < 10; ++i) last = ask(0, RenderService::Priority::Interactive, {64 + i, 64});
    ASSERT_TRUE(waitFor([&] { return !replies.empty() && replies.back().number == last; }));
    EXPECT_LE(replies.size(), 2u);
    EXPECT_EQ(replies.back().picture.width(), 73);
}

TEST_F(RenderServiceTest, AFullPictureGivesWayToASliceAndIsDrawnAgain) {
    const auto full = ask(3, RenderService::Priority::Full, {600, 600}, 0.1);
    QTest::qWait(60);
    ASSERT_TRUE(replies.empty()) << "the full picture is too fast for this test";
    const auto slice = ask(0, RenderService::Priority::Slice, {32, 32});
    ASSERT_TRUE(waitReplies(1));
    EXPECT_EQ(replies[0].number, slice);
    ASSERT_TRUE(waitReplies(2));
    EXPECT_EQ(replies[1].number, full);
    EXPECT_EQ(replies[1].picture.width(), 600);
}

TEST_F(RenderServiceTest, ARefinementGivesWayToASliceAndGoesOnWhereItWas) {
    Scene scene = scan.scene;
    scene.picture.size = {300, 300};
    scene.quality.stepVoxels = 0.1;
    const auto full = service.request({3, scene, scan.volumes, RenderService::Priority::Full, true});
    ASSERT_TRUE(waitReplies(1));
    const auto slice = ask(0, RenderService::Priority::Slice, {32, 32});
    ASSERT_TRUE(waitFor([&] { return replies.back().number == full && replies.back().isFinal; }));
    ASSERT_EQ(replies.size(), 5u) << "four stages, none of them twice, and the slice";
    std::vector<double> steps;
    bool sliceWasBetween = false;
    for (const auto& reply : replies) {
        if (reply.number == full)
            steps.push_back(reply.frame->plan.stepMm);
        else
            sliceWasBetween = reply.number == slice && !steps.empty() && steps.size() < 4;
    }
    EXPECT_TRUE(sliceWasBetween);
    const double last = steps.back();
    EXPECT_EQ(steps, (std::vector{4.0 * last, 2.0 * last, last, last}));
}

TEST_F(RenderServiceTest, AnErrorThatCannotBeMeasuredLeavesThePicture) {
    // A step that the device draws and whose quarter it refuses, in a mode whose rays are drawn whole.
    auto renderer = renderer::Renderer::headless().value();
    Scene scene = scan.scene;
    scene.picture.size = {16, 16};
    scene.mode = Mode::Mip;
    scene.quality.stepVoxels = 1.0;
    while (renderer.render(scene, scan.volumes) && scene.quality.stepVoxels > 1e-9)
        scene.quality.stepVoxels /= 2.0;
    // However many turns a device's loops may take, the plan ends at 16 million samples a ray.
    ASSERT_GT(scene.quality.stepVoxels, 1e-9);
    scene.quality.stepVoxels *= 2.0;
    service.request({3, scene, scan.volumes, RenderService::Priority::Full, true});
    ASSERT_TRUE(waitFor([&] { return !replies.empty() && replies.back().isFinal; }));
    ASSERT_FALSE(replies.back().error) << replies.back().error->text();
    EXPECT_EQ(replies.back().picture.width(), 16);
    EXPECT_EQ(replies.back().frame->error->method, "a first idea from a picture with twice the step");
}

TEST_F(RenderServiceTest, ANewerFullPictureReplacesTheRunningOne) {
    ask(3, RenderService::Priority::Full, {1200, 1200}, 0.02);
    QTest::qWait(100);
    const auto newer = ask(3, RenderService::Priority::Full, {50, 40});
    ASSERT_TRUE(waitReplies(1));
    QTest::qWait(200);
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(replies[0].number, newer);
}

TEST_F(RenderServiceTest, ACancelledChannelIsSilent) {
    ask(4, RenderService::Priority::Export, {2000, 2000}, 0.02);
    QTest::qWait(50);
    service.cancel(4);
    const auto next = ask(0, RenderService::Priority::Slice, {32, 32});
    ASSERT_TRUE(waitReplies(1));
    EXPECT_EQ(replies[0].number, next);
}

TEST_F(RenderServiceTest, AnErrorComesBackAsASentence) {
    Scene scene = scan.scene;
    scene.picture.size = {0, 10};
    service.request({0, scene, scan.volumes, RenderService::Priority::Slice, false});
    ASSERT_TRUE(waitReplies(1));
    ASSERT_TRUE(replies[0].error);
    EXPECT_EQ(replies[0].error->code, ErrorCode::InvalidArgument);
    EXPECT_FALSE(replies[0].frame);
}

}  // namespace
}  // namespace pellucid::test
