// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/load_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

namespace pellucid::app {

LoadBar::LoadBar(QWidget* parent)
    : QFrame(parent), m_label(new QLabel(this)), m_progress(new QProgressBar(this)) {
    setObjectName(QStringLiteral("loadBar"));
    m_label->setObjectName(QStringLiteral("loadText"));
    m_label->setTextFormat(Qt::PlainText);
    m_progress->setObjectName(QStringLiteral("loadProgress"));
    m_progress->setRange(0, 100);
    m_progress->setFixedWidth(260);
    auto* cancel = new QPushButton(tr("Cancel"), this);
    cancel->setObjectName(QStringLiteral("loadCancel"));
    connect(cancel, &QPushButton::clicked, this, &LoadBar::cancelAsked);
    auto* layout = new QHBoxLayout(this);
    layout->addWidget(m_label, 1);
    layout->addWidget(m_progress);
    layout->addWidget(cancel);
    hide();
}

void LoadBar::begin(const QString& what) {
    m_title = what;
    report(0.0, {});
    show();
}

void LoadBar::report(double fraction, const QString& what) {
    m_label->setText(what.isEmpty() ? tr("Opening %1").arg(m_title)
                                    : tr("Opening %1: %2").arg(m_title, what));
    m_progress->setValue(static_cast<int>(fraction * 100.0));
}

}  // namespace pellucid::app
