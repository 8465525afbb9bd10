// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <QTest>
#include <functional>
#include <vector>

#include "app/desktop/main_window.h"
#include "app/desktop/slice_view.h"
#include "app/desktop/volume_view.h"

namespace pellucid::test {

/// A small CT-like volume, 24 x 20 x 16 voxels of 2 x 3 x 4 mm whose first voxel centre lies at (-20, -30,
/// -40) mm: a bright ball in soft tissue, with a value that grows along i so that no two columns look alike.
[[nodiscard]] VolumePtr smallVolume(const std::string& unit = "HU");
[[nodiscard]] app::OpenedScan smallScan(const std::string& unit = "HU");

/// Waits for a condition while events run; true when it came true in time.
[[nodiscard]] bool waitFor(const std::function<bool()>& condition, int timeoutMs = 20000);

/// A main window on the small volume with all four pictures complete.
class GuiTest : public ::testing::Test {
protected:
    void SetUp() override;
    /// Waits until every view shows the picture of the present scene.
    [[nodiscard]] bool settle();
    /// Presses, moves in steps and releases, as a hand does.
    static void dragMouse(QWidget* widget, Qt::MouseButton button, Qt::KeyboardModifiers modifiers,
                          QPoint from, QPoint to);
    static void turnWheel(QWidget* widget, int notches, Qt::KeyboardModifiers modifiers = Qt::NoModifier);

    template <class T>
    T* child(const char* objectName) {
        T* found = window.findChild<T*>(QLatin1String(objectName));
        if (!found) ADD_FAILURE() << "no child named " << objectName;
        return found;
    }
    template <class T>
    T* childOf(const char* parent, const char* objectName) {
        return child<QWidget>(parent)->template findChild<T*>(QLatin1String(objectName));
    }
    app::Document& document() { return window.document(); }
    app::SliceView* axial() { return child<app::SliceView>("axialView"); }
    app::SliceView* coronal() { return child<app::SliceView>("coronalView"); }
    app::SliceView* sagittal() { return child<app::SliceView>("sagittalView"); }
    app::VolumeView* volumeView() { return child<app::VolumeView>("volumeView"); }

    app::MainWindow window;
};

}  // namespace pellucid::test
