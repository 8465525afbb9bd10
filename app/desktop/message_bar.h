// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QFrame>

class QLabel;

namespace pellucid::app {

/// A line above the views for what the user must know: whole sentences that can be read, selected and put
/// away, in no one's way. Hidden while there is nothing to say.
class MessageBar : public QFrame {
    Q_OBJECT

public:
    enum class Kind { Error, Warning, Note };

    explicit MessageBar(QWidget* parent = nullptr);

    void say(Kind kind, const QString& text);
    [[nodiscard]] QString text() const;

private:
    QLabel* m_label;
};

}  // namespace pellucid::app
