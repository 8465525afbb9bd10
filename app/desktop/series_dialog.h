// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>
#include <vector>

#include "io/dicom_series.h"

class QListWidget;

namespace pellucid::app {

/// Which of several series to open.
class SeriesDialog : public QDialog {
    Q_OBJECT

public:
    explicit SeriesDialog(const std::vector<io::DicomSeries>& series, QWidget* parent = nullptr);

Q_SIGNALS:
    void chosen(const std::string& uid);

private:
    void choose();

    std::vector<std::string> m_uids;
    QListWidget* m_list;
};

}  // namespace pellucid::app
