// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>
#include <QElapsedTimer>
#include <filesystem>

#include "app/desktop/verify_run.h"

class QCheckBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace pellucid::app {

/// Help > Verify accuracy: runs the self-test of the renderer on this machine, shows its rows as they come,
/// and writes the report that `pellucid verify` prints. Closing it while it runs cancels the run; the dialog
/// then deletes itself once the run has ended.
class VerifyDialog : public QDialog {
    Q_OBJECT

public:
    explicit VerifyDialog(QWidget* parent = nullptr, Verify verify = accuracy::verify);

    void done(int result) override;

private:
    void build();
    [[nodiscard]] accuracy::VerificationParts chosenParts() const;
    void runOrCancel();
    void addRow(const accuracy::VerificationLine& line);
    void finish(std::shared_ptr<const accuracy::Verification> verification, const Error* error);
    void updateButtons();
    [[nodiscard]] QString countText() const;
    void saveReport();

    QCheckBox* m_step;
    QCheckBox* m_grid;
    QCheckBox* m_pixel;
    QCheckBox* m_extreme;
    QTableWidget* m_table;
    QProgressBar* m_progress;
    QLabel* m_summary;
    QPushButton* m_run;
    QPushButton* m_save;
    QElapsedTimer m_since;
    int m_failed = 0;
    bool m_isClosed = false;
    std::shared_ptr<const accuracy::Verification> m_verification;  ///< Of the last complete run.
    VerifyRun m_runner;
};

/// Writes the report: JSON to a name that ends in .json, else text. Errors: WriteFailed.
[[nodiscard]] Result<void> writeVerification(const std::filesystem::path& file,
                                             const accuracy::Verification& verification);

}  // namespace pellucid::app
