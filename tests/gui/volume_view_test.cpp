// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <QElapsedTimer>
#include <QKeyEvent>
#include <QLabel>
#include <QToolButton>
#include <ctime>
#include <glm/geometric.hpp>

#include "renderer/resize.h"
#include "scene/image.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

class VolumeViewTest : public GuiTest {
protected:
    /// Changes the view a little, picture by picture, until the frame time is held; then at rest.
    void adapt() {
        for (int i = 0; i < 8; ++i) {
            document().change("zoom", {}, [&](Scene& scene) { scene.camera.zoom *= 1.001; });
            ASSERT_TRUE(waitFor([&] { return volumeView()->isSettled(); }));
        }
        ASSERT_TRUE(settle());
    }
};

TEST_F(VolumeViewTest, ShowsThePictureOfTheDocumentsSceneWithItsError) {
    const auto& reply = volumeView()->lastReply();
    ASSERT_TRUE(reply && reply->frame);
    EXPECT_EQ(reply->frame->image.size, volumeView()->pixelSize());
    EXPECT_TRUE(reply->frame->error);
    auto renderer = renderer::Renderer::headless().value();
    EXPECT_EQ(renderer.render(volumeView()->shownScene(), document().volumes()).value().image,
              reply->frame->image);
    EXPECT_EQ(volumeView()->letters(), (EdgeLetters{"R", "L", "S", "I"}));
}

TEST_F(VolumeViewTest, LeftDragRotatesAboutTheTargetAsOneStep) {
    const Scene before = document().scene();
    const CameraPose start =
        app::editablePose(before.camera, document().volume().grid(),
                          static_cast<double>(volumeView()->width()) / volumeView()->height());
    const int quarter = volumeView()->height() / 2;  // Half the height is a quarter turn.
    dragMouse(volumeView(), Qt::LeftButton, Qt::NoModifier, {100, 100}, {100 + quarter, 100});
    ASSERT_TRUE(document().scene().camera.pose);
    const CameraPose pose = *document().scene().camera.pose;
    EXPECT_EQ(pose.target, start.target);
    const double angle = 3.14159265358979 * quarter / volumeView()->height();
    EXPECT_NEAR(glm::distance(pose.eye, app::rotated(start, angle, 0.0).eye), 0.0, 1e-6);
    ASSERT_TRUE(settle());
    EXPECT_EQ(volumeView()->letters().right,
              volumeView()->height() % 2 == 0 ? "A" : volumeView()->letters().right);
    EXPECT_EQ(document().undoStack().undoName(), "Rotate");
    document().undo();
    EXPECT_EQ(document().scene(), before);
    document().redo();
    EXPECT_EQ(*document().scene().camera.pose, pose);
}

using renderer::Passing;

/// The replies that a view shows, as they come.
std::vector<app::RenderService::Reply>& collect(app::VolumeView* view,
                                                std::vector<app::RenderService::Reply>& replies) {
    QObject::connect(view, &app::ViewWidget::pictureShown,
                     [&replies](const app::RenderService::Reply& reply) { replies.push_back(reply); });
    return replies;
}

TEST_F(VolumeViewTest, APictureInPassingComesFirstAndThenFinerAndFinerOnes) {
    // So little time that not even this small scan is drawn in full.
    volumeView()->setFrameTargetMs(1.0);
    adapt();
    std::vector<app::RenderService::Reply> replies;
    collect(volumeView(), replies);
    volumeView()->setStandardView(AnatomicalView::Left);
    ASSERT_TRUE(waitFor([&] { return !replies.empty(); }));
    EXPECT_TRUE(child<QLabel>("cost")->text().startsWith(QStringLiteral("moving: 1/")))
        << child<QLabel>("cost")->text().toStdString();
    ASSERT_TRUE(waitFor([&] { return replies.size() >= 3; }));
    EXPECT_TRUE(child<QLabel>("cost")->text().contains(QStringLiteral("refining; error about")))
        << child<QLabel>("cost")->text().toStdString();
    ASSERT_TRUE(settle());

    const glm::ivec2 full = volumeView()->pixelSize();
    const double asked = stepMm(document().scene().quality, document().volume().grid());
    const auto& first = replies.front();
    ASSERT_TRUE(first.passing);
    EXPECT_GT(first.passing->reduction, 1.0);
    EXPECT_EQ(first.frame->image.size, renderer::reducedSize(full, first.passing->reduction));
    EXPECT_EQ(first.frame->plan.stepMm, asked * first.passing->stepTimes);
    EXPECT_FALSE(first.frame->error);
    std::vector<double> steps;
    for (std::size_t i = 0; i < replies.size(); ++i) {
        const auto& reply = replies[i];
        EXPECT_EQ(reply.picture.size(), QSize(full.x, full.y));
        if (i == 0) continue;
        EXPECT_EQ(reply.frame->image.size, full);
        EXPECT_EQ(reply.isFinal, i + 1 == replies.size());
        EXPECT_EQ(reply.frame->error.has_value(), i > 1) << "the first has nothing to be compared with";
        steps.push_back(reply.frame->plan.stepMm / asked);
    }
    // From what is better than the picture in passing; the last is the same again, with its error.
    ASSERT_GE(steps.size(), 2u);
    EXPECT_LE(steps.front(), 4.0);
    for (std::size_t i = 1; i + 1 < steps.size(); ++i) EXPECT_EQ(steps[i], steps[i - 1] / 2.0);
    EXPECT_EQ(steps[steps.size() - 2], 1.0);
    EXPECT_EQ(steps.back(), 1.0);
    EXPECT_EQ(replies[replies.size() - 2].picture, replies.back().picture);
    EXPECT_TRUE(child<QLabel>("cost")->text().contains(
        QStringLiteral(" at most   |   steps of 0.5 voxels, exponential")))
        << child<QLabel>("cost")->text().toStdString();
}

TEST_F(VolumeViewTest, WhatFitsIntoTheFrameTimeIsDrawnAsItWillStand) {
    volumeView()->setFrameTargetMs(5000.0);
    adapt();
    std::vector<app::RenderService::Reply> replies;
    collect(volumeView(), replies);
    volumeView()->setStandardView(AnatomicalView::Left);
    ASSERT_TRUE(settle());
    EXPECT_EQ(replies.front().passing, Passing{});
    EXPECT_EQ(replies.front().picture, replies.back().picture);
    ASSERT_EQ(replies.size(), 3u) << "in passing, at rest, and with its error: nothing worse in between";
}

TEST_F(VolumeViewTest, AnEventEndsTheRefinementAtOnce) {
    // Some seconds for the picture with the whole step.
    document().change("step", {}, [](Scene& scene) { scene.quality.stepVoxels = 0.01; });
    std::vector<app::RenderService::Reply> replies;
    collect(volumeView(), replies);
    ASSERT_TRUE(waitFor(
        [&] { return !replies.empty() && replies.back().priority == app::RenderService::Priority::Full; }));
    ASSERT_FALSE(replies.back().isFinal) << "too fast for this test";
    const auto number = replies.back().number;
    replies.clear();
    document().change("step", {}, [](Scene& scene) { scene.quality.stepVoxels = 1.0; });
    QElapsedTimer since;
    since.start();
    ASSERT_TRUE(waitFor([&] { return !replies.empty(); }));
    EXPECT_EQ(replies.front().priority, app::RenderService::Priority::Interactive);
    EXPECT_LT(since.elapsed(), 1000) << "the rest of the fine pictures is not waited for";
    ASSERT_TRUE(settle());
    for (const auto& reply : replies) EXPECT_GT(reply.number, number);
}

glm::dvec3 meanColor(const ImageF& image) {
    glm::dvec3 sum(0.0);
    for (const glm::vec4& pixel : image.pixels) sum += glm::dvec3(pixel);
    return sum / static_cast<double>(image.pixels.size());
}

TEST_F(VolumeViewTest, WhileTheHandMovesNothingIsChosenAndTheBrightnessStays) {
    document().change("quality", {}, [](Scene& scene) {
        scene.quality.automatic = true;
        scene.densityScale = 0.2;  // Faint, where a wrong step would show most.
    });
    ASSERT_TRUE(settle());
    const Quality chosen = volumeView()->lastReply()->frame->chosen.value();
    std::vector<app::RenderService::Reply> replies;
    collect(volumeView(), replies);
    volumeView()->setStandardView(AnatomicalView::Left);
    ASSERT_TRUE(settle());
    const renderer::Frame& moving = *replies.front().frame;
    const renderer::Frame& still = *replies.back().frame;
    EXPECT_EQ(replies.front().priority, app::RenderService::Priority::Interactive);
    EXPECT_FALSE(moving.chosen);
    EXPECT_EQ(moving.plan.features.integrator, chosen.integrator);
    ASSERT_TRUE(replies.front().passing);
    Quality longer = chosen;
    longer.stepVoxels *= replies.front().passing->stepTimes;
    EXPECT_EQ(moving.plan.stepMm, stepMm(longer, document().volume().grid()));
    EXPECT_TRUE(still.chosen);
    const glm::dvec3 apart = meanColor(moving.image) - meanColor(still.image);
    EXPECT_GT(glm::length(meanColor(still.image)), 5.0 / 255.0) << "an empty picture proves nothing";
    EXPECT_LT(glm::length(apart), 1.0 / 255.0);
}

TEST_F(VolumeViewTest, APreviewOfTheTableGivesWayToTheExactOne) {
    document().change("integrator", {},
                      [](Scene& scene) { scene.quality.integrator = Integrator::Preintegrated2D; });
    ASSERT_TRUE(settle());
    std::vector<app::RenderService::Reply> replies;
    collect(volumeView(), replies);
    // On a busy machine the exact table may be there before the thread that draws gets its turn.
    for (int change = 0; change < 10 && (replies.empty() || !replies.front().frame->preview); ++change) {
        replies.clear();
        document().changeItem("curve", {}, [](VolumeItem& item) {
            for (auto& point : item.transferFunction->points) point.color *= 0.9;
        });
        ASSERT_TRUE(settle());
    }
    ASSERT_GE(replies.size(), 2u);
    EXPECT_EQ(replies.front().priority, app::RenderService::Priority::Interactive);
    EXPECT_TRUE(replies.front().frame->preview) << "the exact table is not waited for";
    EXPECT_FALSE(replies.back().frame->preview);
    auto renderer = renderer::Renderer::headless().value();
    EXPECT_EQ(renderer.render(volumeView()->shownScene(), document().volumes()).value().image,
              replies.back().frame->image);
}

TEST_F(VolumeViewTest, WheelAndRightDragZoomAndMiddleDragPans) {
    turnWheel(volumeView(), 1);
    EXPECT_NEAR(document().scene().camera.zoom, 1.15, 1e-12);
    document().endGesture();
    dragMouse(volumeView(), Qt::RightButton, Qt::NoModifier, {50, 150}, {50, 75});
    EXPECT_NEAR(document().scene().camera.zoom, 1.15 * std::exp(0.5), 1e-12);
    const CameraPose before = *document().scene().camera.pose;
    dragMouse(volumeView(), Qt::MiddleButton, Qt::NoModifier, {50, 50}, {70, 50});
    const CameraPose after = *document().scene().camera.pose;
    EXPECT_LT(after.target.x, before.target.x)
        << "the object goes to the right, so the target goes to the left";
    EXPECT_EQ(after.eye - before.eye, after.target - before.target);
    dragMouse(volumeView(), Qt::RightButton, Qt::ControlModifier, {50, 150}, {50, 75});
    EXPECT_NEAR(glm::distance(document().scene().camera.pose->eye, after.target),
                glm::distance(after.eye, after.target) * std::exp(-0.5), 1e-9);
    dragMouse(volumeView(), Qt::LeftButton, Qt::ControlModifier, {50, 20}, {150, 20});
    EXPECT_EQ(document().undoStack().undoName(), "Roll");
}

TEST_F(VolumeViewTest, ButtonsLettersAndKeypadGiveTheStandardViews) {
    child<QToolButton>("viewS")->click();
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Superior);
    EXPECT_EQ(document().undoStack().undoName(), "View from superior");
    QTest::keyClick(volumeView(), Qt::Key_P);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Posterior);
    EXPECT_EQ(volumeView()->letters().left, "L");
    QTest::keyClick(volumeView(), Qt::Key_R, Qt::ShiftModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Right);
    QTest::keyClick(volumeView(), Qt::Key_1, Qt::KeypadModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Anterior);
    QTest::keyClick(axial(), Qt::Key_7, Qt::KeypadModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Superior);
    QTest::keyClick(axial(), Qt::Key_End, Qt::KeypadModifier | Qt::ShiftModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Posterior);
    turnWheel(volumeView(), 3);
    QTest::keyClick(volumeView(), Qt::Key_R);
    EXPECT_FALSE(document().scene().camera.pose);
    EXPECT_EQ(document().scene().camera.zoom, 1.0);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Posterior);
}

TEST_F(VolumeViewTest, NothingIsDrawnWhileNothingChanges) {
    int pictures = 0;
    QObject::connect(&window.renderService(), &app::RenderService::replied,
                     [&](const app::RenderService::Reply&) { ++pictures; });
    // A window changes no composite, so only the slices are drawn.
    document().changeItem("window", {}, [](VolumeItem& item) { item.window = Window{0, 100}; });
    ASSERT_TRUE(settle());
    EXPECT_EQ(pictures, 3);
    const std::clock_t before = std::clock();
    QTest::qWait(1000);  // Longer than the rest after which the full picture is drawn.
    EXPECT_EQ(pictures, 3);
    // Of all threads: some ms for the wait itself. One that polled or drew would take most of it.
    EXPECT_LT(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 0.03);
}

}  // namespace
}  // namespace pellucid::test
