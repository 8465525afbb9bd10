// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What a hand feels: the desktop with a scan, its 3D view alone at 1024 x 768, turned and re-coloured as by a
// mouse that reports every 8 ms. Prints how often a new picture comes, how long the window takes to answer,
// how far pictures in passing are from the still one, and the processor time of a window at rest.
//
//   xvfb-run -a -s "-screen 0 1600x1000x24" interaction [SCAN]
//
// Without a scan: a synthetic CT of 512 x 512 x 300 voxels. Each of four cases: the default look and the bone
// preset, lit and unlit.
#include <fmt/format.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <ctime>

#include "accuracy/synthetic.h"
#include "app/desktop/main_window.h"
#include "app/desktop/theme.h"
#include "app/desktop/volume_view.h"
#include "renderer/resize.h"
#include "scene/presets.h"

namespace pellucid::bench {
namespace {

using app::RenderService;

constexpr int kGestureMs = 6000;
constexpr int kMouseMs = 8;

/// Ends the program with the sentence when nothing comes.
void waitFor(const std::function<bool()>& condition, int timeoutMs) {
    if (!QTest::qWaitFor(condition, timeoutMs))
        contractBroken(__FILE__, __LINE__, fmt::format("nothing came in {} s", timeoutMs / 1000));
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return std::nan("");
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

glm::dvec3 meanColor(const QImage& picture) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const QRgb pixel = picture.pixel(x, y);
            sum += glm::dvec3(qRed(pixel), qGreen(pixel), qBlue(pixel));
        }
    return sum / (static_cast<double>(picture.width()) * picture.height());
}

double rmsApart(const QImage& a, const QImage& b) {
    double sum = 0.0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
            const glm::dvec3 apart(qRed(p) - qRed(q), qGreen(p) - qGreen(q), qBlue(p) - qBlue(q));
            sum += (apart.x * apart.x + apart.y * apart.y + apart.z * apart.z) / 3.0;
        }
    return std::sqrt(sum / (static_cast<double>(a.width()) * a.height()));
}

/// A window whose replies and event loop are watched.
class Watch {
public:
    explicit Watch(app::MainWindow& window)
        : m_window(window), m_view(window.findChild<app::VolumeView*>(QStringLiteral("volumeView"))) {
        QObject::connect(m_view, &app::ViewWidget::pictureShown, [this](const RenderService::Reply& reply) {
            if (!reply.frame) return;
            if (reply.passing) {
                m_pictureMs.push_back(static_cast<double>(m_clock.elapsed()));
                m_totalMs.push_back(reply.totalMs);
                m_otherMs.push_back(reply.totalMs - reply.frame->cost.gpuMs);
                m_passing = reply;
            }
        });
    }

    app::VolumeView* view() const { return m_view; }

    /// `move(i)` every 8 ms; events are timed by how late a timer of 5 ms comes.
    void gesture(const std::string& name, const std::function<void(int)>& move) {
        m_pictureMs.clear(), m_totalMs.clear(), m_otherMs.clear();
        std::vector<double> lateMs, moveMs;
        QElapsedTimer beat;
        beat.start();
        QTimer heart, mouse;
        heart.setTimerType(Qt::PreciseTimer);
        QObject::connect(&heart, &QTimer::timeout, [&] {
            lateMs.push_back(static_cast<double>(beat.nsecsElapsed()) * 1e-6 - 5.0);
            beat.restart();
        });
        int moves = 0;
        QObject::connect(&mouse, &QTimer::timeout, [&] {
            QElapsedTimer took;
            took.start();
            move(moves++);
            moveMs.push_back(static_cast<double>(took.nsecsElapsed()) * 1e-6);
        });
        heart.start(5);
        mouse.start(kMouseMs);
        m_clock.start();
        QTest::qWait(kGestureMs);
        heart.stop(), mouse.stop();
        std::vector<double> apartMs;
        for (std::size_t i = 1; i < m_pictureMs.size(); ++i)
            apartMs.push_back(m_pictureMs[i] - m_pictureMs[i - 1]);
        fmt::print(
            "  {:<16} {:5.1f} pictures/s (median {:.0f} ms apart, 95 % {:.0f}, worst {:.0f}; of it not "
            "drawing {:.0f})   "
            "input answered in: median {:.1f}, 99 % {:.1f}, worst {:.1f} ms\n",
            name, 1000.0 * static_cast<double>(m_pictureMs.size()) / kGestureMs, quantile(apartMs, 0.5),
            quantile(apartMs, 0.95), quantile(apartMs, 1.0), quantile(m_otherMs, 0.5), quantile(lateMs, 0.5),
            quantile(lateMs, 0.99), std::max(quantile(lateMs, 1.0), quantile(moveMs, 1.0)));
    }

    void drag() {
        const auto send = [&](QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held) {
            QMouseEvent event(type, at, m_view->mapToGlobal(at), button, held, Qt::NoModifier);
            QApplication::sendEvent(m_view, &event);
        };
        send(QEvent::MouseButtonPress, {500, 300}, Qt::LeftButton, Qt::LeftButton);
        QPointF at;
        gesture("camera drag", [&](int i) {
            at = {500.0 + 0.7 * i, 300.0 + 60.0 * std::sin(0.01 * i)};
            send(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton);
        });
        send(QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton);
    }

    void editFunction() {
        gesture("function edit", [&](int i) {
            m_window.document().changeItem("curve", "curve", [&](VolumeItem& item) {
                for (auto& point : item.transferFunction->points) point.value += 0.5 * std::sin(0.02 * i);
            });
        });
        m_window.document().endGesture();
    }

    /// Against the still picture of the scene that the last gesture ended with.
    void rest() {
        waitFor([&] { return m_view->isSettled() && m_passing && m_passing->passing; }, 10000);
        const RenderService::Reply passing = *m_passing;
        QElapsedTimer clock;
        clock.start();
        double firstMs = 0.0, askedMs = 0.0;
        const double asked = stepMm(m_window.document().scene().quality, m_window.document().volume().grid());
        const auto seen =
            QObject::connect(m_view, &app::ViewWidget::pictureShown, [&](const RenderService::Reply& reply) {
                if (reply.passing || !reply.frame) return;
                if (firstMs == 0.0) firstMs = static_cast<double>(clock.elapsed());
                if (askedMs == 0.0 && reply.frame->plan.stepMm <= asked)
                    askedMs = static_cast<double>(clock.elapsed());
            });
        waitFor([&] { return askedMs > 0.0; }, 120000);
        QObject::disconnect(seen);
        const QImage still = m_view->picture();
        const glm::dvec3 apart = meanColor(passing.picture) - meanColor(still);
        const auto stated = m_view->interaction().error(*passing.passing);
        fmt::print(
            "  at rest          1/{:g} size, {:g}x step: stated {:.2f}, measured {:.2f} grey levels RMS; "
            "mean colour off by {:.2f} "
            "{:.2f} {:.2f}; full size after {:.0f} ms, with the step asked for after {:.0f} ms\n",
            passing.passing->reduction, passing.passing->stepTimes, stated ? *stated * 255.0 : std::nan(""),
            rmsApart(passing.picture, still), apart.r, apart.g, apart.b, firstMs, askedMs);
    }

    void idle() {
        waitFor([&] { return m_view->isComplete(); }, 300000);
        const std::clock_t before = std::clock();
        QTest::qWait(2000);
        fmt::print("  idle             {:.2f} % of a processor\n",
                   100.0 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC / 2.0);
    }

private:
    app::MainWindow& m_window;
    app::VolumeView* m_view;
    QElapsedTimer m_clock;
    std::vector<double> m_pictureMs, m_totalMs, m_otherMs;
    std::optional<RenderService::Reply> m_passing;
};

Result<app::OpenedScan> opened(int argc, char** argv) {
    if (argc > 1) return app::openScan({argv[1]}, {});
    return app::scanFrom(Scene{}, {accuracy::ctLikeShells(glm::ivec3(512, 512, 300))});
}

void measure(app::MainWindow& window, Watch& watch) {
    for (const char* preset : {"", "CT bone"}) {
        for (const bool lit : {false, true}) {
            window.document().change("look", {}, [&](Scene& scene) {
                if (const auto* found = findVolumePreset(preset))
                    scene.volumes.front().transferFunction = found->function;
                scene.lights = lit ? std::vector<Light>{Light{}} : std::vector<Light>{};
            });
            fmt::print("{}, {}\n", *preset ? preset : "default look", lit ? "lit" : "unlit");
            watch.drag();
            watch.rest();
            watch.drag();
            watch.rest();
            watch.editFunction();
            watch.rest();
            std::fflush(stdout);
        }
    }
    window.document().change("quick", {}, [](Scene& scene) { scene.quality.stepVoxels = 4.0; });
    watch.idle();
}

}  // namespace
}  // namespace pellucid::bench

int main(int argc, char** argv) {
    using namespace pellucid;
    QApplication application(argc, argv);
    QTemporaryDir settings;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    QApplication::setOrganizationName(QStringLiteral("PellucidBench"));
    QApplication::setApplicationName(QStringLiteral("PellucidBench"));
    app::applyTheme(application);
    auto scan = bench::opened(argc, argv);
    if (!scan) {
        fmt::print(stderr, "{}\n", scan.error().text());
        return 2;
    }
    app::MainWindow window;
    window.resize(1600, 1000);
    window.show();
    bench::Watch watch(window);
    window.showScan(std::move(*scan));
    bench::waitFor([&] { return watch.view()->isSettled(); }, 60000);
    Q_EMIT watch.view()->maximiseAsked();
    QTest::qWait(100);
    // What is around the view depends on the theme; the view is to have its size exactly.
    window.resize(window.width() + 1024 - watch.view()->width(),
                  window.height() + 768 - watch.view()->height());
    QTest::qWait(300);
    fmt::print("view of {} x {} pixels\n", watch.view()->pixelSize().x, watch.view()->pixelSize().y);
    bench::measure(window, watch);
    return 0;
}
