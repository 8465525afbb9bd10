// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/series_dialog.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QListWidget>
#include <QVBoxLayout>

namespace pellucid::app {

SeriesDialog::SeriesDialog(const std::vector<io::DicomSeries>& series, QWidget* parent)
    : QDialog(parent), m_list(new QListWidget(this)) {
    setObjectName(QStringLiteral("seriesDialog"));
    setWindowTitle(tr("Choose a series"));
    m_list->setObjectName(QStringLiteral("seriesList"));
    for (const io::DicomSeries& one : series) {
        const QString description =
            one.description.empty() ? tr("without description") : QString::fromStdString(one.description);
        m_list->addItem(tr("%1   %2   (%n files)", nullptr, static_cast<int>(one.files.size()))
                            .arg(QString::fromStdString(one.modality), description));
        m_list->item(m_list->count() - 1)->setToolTip(QString::fromStdString(one.uid));
        m_uids.push_back(one.uid);
    }
    m_list->setCurrentRow(0);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel, this);
    connect(buttons, &QDialogButtonBox::accepted, this, &SeriesDialog::choose);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(m_list, &QListWidget::itemDoubleClicked, this, &SeriesDialog::choose);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(new QLabel(tr("There are several series here. Which one?"), this));
    layout->addWidget(m_list, 1);
    layout->addWidget(buttons);
    resize(520, 320);
}

void SeriesDialog::choose() {
    const int row = m_list->currentRow();
    if (row < 0) return;
    Q_EMIT chosen(m_uids[static_cast<std::size_t>(row)]);
    accept();
}

}  // namespace pellucid::app
