// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The desktop as the command line starts it: with the sample scan as its argument.
#include <gtest/gtest.h>

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>

#include "app/desktop/desktop.h"
#include "app/desktop/main_window.h"
#include "app/desktop/volume_view.h"
#include "tests/gui/display.h"

namespace pellucid::test {
namespace {

struct Seen {
    bool isComplete = false;
    std::string title;
    Mode mode = Mode::Slice;
    glm::ivec3 size{0};
} seen;

/// Looks at the running program until its 3D picture is complete, notes what it sees, and ends it.
void watch() {
    for (QWidget* widget : QApplication::topLevelWidgets()) {
        auto* window = qobject_cast<app::MainWindow*>(widget);
        if (!window || window->document().isEmpty()) continue;
        const auto* view = window->findChild<app::VolumeView*>();
        if (!view->isComplete()) continue;
        seen = {true, window->windowTitle().toStdString(), window->document().scene().mode,
                window->document().volume().grid().size};
        window->close();
        return;
    }
    QTimer::singleShot(50, &watch);
}
// Runs as soon as runDesktop has made its application.
void watchWhenStarted() {
    QTimer::singleShot(0, &watch);
}
Q_COREAPP_STARTUP_FUNCTION(watchWhenStarted)

TEST(Start, OpensTheScanOfTheArgumentAndEndsWithItsWindow) {
    QTemporaryDir settings;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    int argc = 1;
    char program[] = "pellucid";
    char* argv[] = {program, nullptr};
    EXPECT_EQ(app::runDesktop(argc, argv,
                              {std::filesystem::path(PELLUCID_SOURCE_DIR) / "resources/sample/sample.json"}),
              0);
    ASSERT_TRUE(seen.isComplete);
    EXPECT_EQ(seen.title, "sample.json[*] - Pellucid");
    EXPECT_EQ(seen.mode, Mode::Composite);
    EXPECT_EQ(seen.size, glm::ivec3(122, 101, 112));
}

}  // namespace
}  // namespace pellucid::test

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    if (!pellucid::test::onlyListsTests()) pellucid::test::provideDisplay();
    return RUN_ALL_TESTS();
}
