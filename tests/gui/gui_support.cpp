// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/gui/gui_support.h"

#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>
#include <cstring>

namespace pellucid::test {

VolumePtr smallVolume(const std::string& unit) {
    const glm::ivec3 size(24, 20, 16);
    std::vector<std::int16_t> values;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const double radius = std::hypot(i - 12, j - 10, k - 8);
                const double tissue = radius < 5 ? 700.0 : radius < 8 ? 40.0 : -1000.0;
                values.push_back(static_cast<std::int16_t>(tissue + i));
            }
    std::vector<std::byte> bytes(values.size() * sizeof(std::int16_t));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    const VolumeInfo info{"small", std::string("CT"), {{"File window", {40.0, 400.0}}}, {}, {}};
    return Volume::make(axisAlignedGrid(size, {2, 3, 4}, {-20, -30, -40}), VoxelType::Int16, 1,
                        std::move(bytes), {1.0, 0.0, unit}, info)
        .value();
}

app::OpenedScan smallScan(const std::string& unit) {
    return app::scanFrom(Scene{}, {smallVolume(unit)}).value();
}

bool waitFor(const std::function<bool()>& condition, int timeoutMs) {
    return QTest::qWaitFor(condition, timeoutMs);
}

void GuiTest::SetUp() {
    window.resize(900, 640);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    window.showScan(smallScan());
    ASSERT_TRUE(settle());
}

bool GuiTest::settle() {
    return waitFor([this] {
        return axial()->isSettled() && coronal()->isSettled() && sagittal()->isSettled() &&
               volumeView()->isComplete();
    });
}

void GuiTest::dragMouse(QWidget* widget, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPoint from,
                        QPoint to) {
    const auto send = [&](QEvent::Type type, QPoint at, Qt::MouseButton changed, Qt::MouseButtons held) {
        QMouseEvent event(type, at, widget->mapToGlobal(at), changed, held, modifiers);
        QApplication::sendEvent(widget, &event);
    };
    send(QEvent::MouseButtonPress, from, button, button);
    constexpr int kSteps = 5;
    for (int step = 1; step <= kSteps; ++step)
        send(QEvent::MouseMove, from + (to - from) * step / kSteps, Qt::NoButton, button);
    send(QEvent::MouseButtonRelease, to, button, Qt::NoButton);
}

void GuiTest::turnWheel(QWidget* widget, int notches, Qt::KeyboardModifiers modifiers) {
    const QPoint at = widget->rect().center();
    QWheelEvent event(at, widget->mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, modifiers,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(widget, &event);
}

}  // namespace pellucid::test
