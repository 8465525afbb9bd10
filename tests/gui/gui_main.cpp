// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The program of the desktop's tests: a display, an application with the desktop's look, settings in a
// temporary folder.
#include <gtest/gtest.h>

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>

#include "app/desktop/theme.h"
#include "tests/gui/display.h"

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    if (pellucid::test::onlyListsTests()) return RUN_ALL_TESTS();
    pellucid::test::provideDisplay();
    QApplication application(argc, argv);
    QTemporaryDir settings;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    QApplication::setOrganizationName(QStringLiteral("PellucidTest"));
    QApplication::setApplicationName(QStringLiteral("PellucidTest"));
    pellucid::app::applyTheme(application);
    return RUN_ALL_TESTS();
}
