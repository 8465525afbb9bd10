// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QFrame>

class QLabel;
class QProgressBar;

namespace pellucid::app {

/// What is being opened, how far it is, and the way to stop it. Hidden while nothing is.
class LoadBar : public QFrame {
    Q_OBJECT

public:
    explicit LoadBar(QWidget* parent = nullptr);

    void begin(const QString& what);
    void report(double fraction, const QString& what);

Q_SIGNALS:
    void cancelAsked();

private:
    QLabel* m_label;
    QProgressBar* m_progress;
    QString m_title;
};

}  // namespace pellucid::app
