// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// A scan that is too much for the frame time, under the hand.
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QMouseEvent>
#include <QSettings>
#include <QTimer>
#include <algorithm>
#include <cmath>

#include "accuracy/synthetic.h"
#include "renderer/resize.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

class InteractionTest : public GuiTest {
protected:
    void SetUp() override {
        GuiTest::SetUp();
        window.showScan(app::scanFrom(Scene{}, {accuracy::ctLikeShells(96)}).value());
        Q_EMIT volumeView()->maximiseAsked();
        ASSERT_TRUE(waitFor([&] { return volumeView()->isSettled(); }));
        QObject::connect(volumeView(), &app::ViewWidget::pictureShown,
                         [this](const app::RenderService::Reply& reply) {
                             if (reply.passing) passed.push_back(reply);
                         });
        document().change("step", {}, [](Scene& scene) { scene.quality.stepVoxels = 1.0; });
    }

    /// Turns the volume for a while as a mouse does that reports every 8 ms.
    void drag(int forMs) {
        const auto send = [&](QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held) {
            QMouseEvent event(type, at, volumeView()->mapToGlobal(at), button, held, Qt::NoModifier);
            QApplication::sendEvent(volumeView(), &event);
        };
        send(QEvent::MouseButtonPress, {300, 200}, Qt::LeftButton, Qt::LeftButton);
        QPointF at;
        QTimer mouse;
        int moves = 0;
        QObject::connect(&mouse, &QTimer::timeout, [&] {
            ++moves;
            at = {300.0 + moves, 200.0 + 0.3 * moves};
            send(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton);
        });
        mouse.start(8);
        QTest::qWait(forMs);
        mouse.stop();
        send(QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton);
    }

    /// Waits for the picture of full size with the scene's own step; that its error is not measured yet saves
    /// time.
    [[nodiscard]] bool waitStill() {
        const double step = stepMm(document().scene().quality, document().volume().grid());
        return waitFor([&] {
            const auto& reply = volumeView()->lastReply();
            return volumeView()->isSettled() && reply && reply->frame && !reply->passing &&
                   reply->frame->plan.stepMm <= step;
        });
    }

    std::vector<app::RenderService::Reply> passed;
};

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

glm::dvec3 meanOf(const QImage& picture) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const QRgb pixel = picture.pixel(x, y);
            sum += glm::dvec3(qRed(pixel), qGreen(pixel), qBlue(pixel));
        }
    return sum / (static_cast<double>(picture.width()) * picture.height());
}

TEST_F(InteractionTest, ADragHoldsTheFrameTimeAndTheWindowAnswers) {
    volumeView()->setFrameTargetMs(40.0);
    QElapsedTimer beat;
    std::vector<double> lateMs;
    QTimer heart;
    heart.setTimerType(Qt::PreciseTimer);
    QObject::connect(&heart, &QTimer::timeout, [&] {
        lateMs.push_back(static_cast<double>(beat.nsecsElapsed()) * 1e-6 - 5.0);
        beat.restart();
    });
    drag(800);  // Comes to know the device.
    passed.clear();
    beat.start();
    heart.start(5);
    drag(1500);
    heart.stop();
    ASSERT_GE(passed.size(), 5u);
    EXPECT_GT(passed.back().passing->reduction, 1.0) << "too fast for this test";
    std::vector<double> totalMs;
    for (const auto& reply : passed) totalMs.push_back(reply.totalMs);
    // Twice the time for a machine that does something else meanwhile.
    EXPECT_LT(medianOf(totalMs), 80.0);
    // Events wait for no picture: they come within 0.1 s, but for a single one where the machine is busy.
    std::sort(lateMs.begin(), lateMs.end());
    ASSERT_GE(lateMs.size(), 20u);
    EXPECT_LT(lateMs[lateMs.size() - 2], 100.0);
}

TEST_F(InteractionTest, APictureInPassingIsAsBrightAsTheStillOneAndSaysHowWrongItIs) {
    const glm::ivec2 size = volumeView()->pixelSize();
    for (const double density : {1.0, 0.05}) {
        document().change("density", {}, [&](Scene& scene) { scene.densityScale = density; });
        ASSERT_TRUE(waitStill());
        drag(400);
        ASSERT_TRUE(waitStill());
        // What a third of the size takes, however busy the machine is: what is tested is no matter of speed.
        const auto target =
            volumeView()->interaction().expectedMs({3.0, 1.0}, static_cast<double>(size.x) * size.y);
        ASSERT_TRUE(target);
        volumeView()->setFrameTargetMs(*target);
        passed.clear();
        drag(600);
        ASSERT_TRUE(waitFor([&] { return volumeView()->isSettled(); }));
        ASSERT_FALSE(passed.empty());
        const app::RenderService::Reply moving = passed.back();
        EXPECT_GT(moving.passing->reduction, 1.0) << "too fast for this test";
        const auto stated = volumeView()->interaction().error(*moving.passing);
        ASSERT_TRUE(stated);
        const QString text = child<QLabel>("cost")->text();
        EXPECT_TRUE(text.startsWith(QStringLiteral("moving: 1/%1 size").arg(moving.passing->reduction)) &&
                    text.contains(QStringLiteral("grey levels RMS from the still picture")))
            << text.toStdString();
        ASSERT_TRUE(waitStill());
        const QImage still = volumeView()->picture();
        ASSERT_EQ(moving.picture.size(), still.size());
        const glm::dvec3 mean = meanOf(still), apart = meanOf(moving.picture) - mean;
        EXPECT_GT(mean.r, 5.0) << "an empty picture proves nothing";
        for (int c = 0; c < 3; ++c) EXPECT_LT(std::abs(apart[c]), 1.0) << density;
        // The view has been turned since the still picture that told the error.
        const auto enlarged = renderer::resized(moving.frame->image, volumeView()->pixelSize());
        const double error = renderer::pictureError(enlarged, volumeView()->lastReply()->frame->image).rmse;
        EXPECT_GT(*stated, error / 2.0);
        EXPECT_LT(*stated, error * 2.0);
    }
}

TEST_F(InteractionTest, TheFrameTimeIsASettingOfTheProgram) {
    const Scene before = document().scene();
    const double deviceMs = volumeView()->interaction().targetMs();
    EXPECT_TRUE(deviceMs == renderer::defaultFrameTargetMs(true) ||
                deviceMs == renderer::defaultFrameTargetMs(false));
    auto* field = childOf<QDoubleSpinBox>("frameTarget", "field");
    EXPECT_EQ(field->value(), deviceMs);
    field->setValue(40.0);
    EXPECT_EQ(volumeView()->interaction().targetMs(), 40.0);
    EXPECT_EQ(document().scene(), before);
    {
        app::MainWindow another;
        auto* view = another.findChild<app::VolumeView*>(QStringLiteral("volumeView"));
        EXPECT_TRUE(waitFor([&] { return view->interaction().targetMs() == 40.0; }));
    }
    QSettings().remove(QStringLiteral("frameTargetMs"));
}

}  // namespace
}  // namespace pellucid::test
