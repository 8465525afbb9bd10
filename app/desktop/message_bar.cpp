// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/message_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStyle>
#include <QToolButton>

namespace pellucid::app {

MessageBar::MessageBar(QWidget* parent) : QFrame(parent), m_label(new QLabel(this)) {
    setObjectName(QStringLiteral("messageBar"));
    m_label->setObjectName(QStringLiteral("messageText"));
    m_label->setWordWrap(true);
    m_label->setTextFormat(Qt::PlainText);  // A file name is never markup.
    m_label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* close = new QToolButton(this);
    close->setObjectName(QStringLiteral("messageClose"));
    close->setText(QString(QChar(0xd7)));
    close->setAutoRaise(true);
    close->setToolTip(tr("Put this message away"));
    connect(close, &QToolButton::clicked, this, &QWidget::hide);
    auto* layout = new QHBoxLayout(this);
    layout->addWidget(m_label, 1);
    layout->addWidget(close, 0, Qt::AlignTop);
    hide();
}

void MessageBar::say(Kind kind, const QString& text) {
    static constexpr const char* kKinds[] = {"error", "warning", "note"};
    setProperty("kind", QLatin1String(kKinds[static_cast<int>(kind)]));
    style()->unpolish(this);
    style()->polish(this);
    m_label->setText(text);
    setVisible(!text.isEmpty());
}

QString MessageBar::text() const {
    return m_label->text();
}

}  // namespace pellucid::app
