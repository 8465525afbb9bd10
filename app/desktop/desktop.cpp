// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/desktop.h"

#include <QApplication>
#include <clocale>

#include "app/desktop/main_window.h"
#include "app/desktop/theme.h"

namespace pellucid::app {

int runDesktop(int argc, char** argv, const std::vector<std::filesystem::path>& paths) {
    QApplication application(argc, argv);
    // Qt takes the user's locale over; the readers below parse numbers and want a full stop.
    std::setlocale(LC_NUMERIC, "C");
    QLocale::setDefault(QLocale::c());
    QApplication::setApplicationName(QStringLiteral("Pellucid"));
    QApplication::setOrganizationName(QStringLiteral("Pellucid"));
    applyTheme(application);
    MainWindow window;
    window.show();
    window.openPaths(paths);
    return QApplication::exec();
}

}  // namespace pellucid::app
