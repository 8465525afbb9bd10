// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/verify_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"

namespace pellucid::app {

namespace {

enum Column { kCase, kTheory, kObserved, kResult, kReason, kColumns };
constexpr QColor kPassed(0x78, 0xb8, 0x6e), kFailed(0xf0, 0x80, 0x74);

}  // namespace

Result<void> writeVerification(const std::filesystem::path& file,
                               const accuracy::Verification& verification) {
    const std::string text = file.extension() == ".json"
                                 ? accuracy::verificationJson(verification).dump(2) + "\n"
                                 : accuracy::verificationText(verification);
    return io::writeFile(file, std::as_bytes(std::span(text)));
}

VerifyDialog::VerifyDialog(QWidget* parent, Verify verify)
    : QDialog(parent),
      m_step(new QCheckBox(tr("&Step"), this)),
      m_grid(new QCheckBox(tr("Voxel &grid"), this)),
      m_pixel(new QCheckBox(tr("&Pixel"), this)),
      m_extreme(new QCheckBox(tr("Stiff and &extreme cases"), this)),
      m_table(new QTableWidget(0, kColumns, this)),
      m_progress(new QProgressBar(this)),
      m_summary(new QLabel(this)),
      m_run(new QPushButton(tr("&Run"), this)),
      m_save(new QPushButton(tr("Save &report..."), this)),
      m_runner(std::move(verify)) {
    setObjectName(QStringLiteral("verifyDialog"));
    setWindowTitle(tr("Verify accuracy"));
    setAttribute(Qt::WA_DeleteOnClose);
    build();
    for (QCheckBox* box : {m_step, m_grid, m_pixel, m_extreme})
        connect(box, &QCheckBox::toggled, this, &VerifyDialog::updateButtons);
    connect(m_run, &QPushButton::clicked, this, &VerifyDialog::runOrCancel);
    connect(m_save, &QPushButton::clicked, this, &VerifyDialog::saveReport);
    connect(&m_runner, &VerifyRun::found, this, &VerifyDialog::addRow);
    connect(&m_runner, &VerifyRun::ended, this,
            [this](std::shared_ptr<const accuracy::Verification> verification,
                   std::shared_ptr<const Error> error) { finish(std::move(verification), error.get()); });
    connect(&m_runner, &VerifyRun::progressed, this, [this](double fraction, const QString& what) {
        m_progress->setValue(static_cast<int>(fraction * m_progress->maximum()));
        m_progress->setFormat(tr("%p %   %1").arg(what));
    });
    updateButtons();
}

void VerifyDialog::build() {
    m_step->setObjectName(QStringLiteral("verifyStep"));
    m_grid->setObjectName(QStringLiteral("verifyGrid"));
    m_pixel->setObjectName(QStringLiteral("verifyPixel"));
    m_extreme->setObjectName(QStringLiteral("verifyExtreme"));
    m_table->setObjectName(QStringLiteral("verifyTable"));
    m_progress->setObjectName(QStringLiteral("verifyProgress"));
    m_summary->setObjectName(QStringLiteral("verifySummary"));
    m_run->setObjectName(QStringLiteral("verifyRun"));
    m_save->setObjectName(QStringLiteral("verifySave"));
    for (QCheckBox* box : {m_step, m_grid, m_pixel}) box->setChecked(true);
    m_step->setToolTip(tr("Errors of finer and finer steps along the ray, against the reference."));
    m_grid->setToolTip(tr("Errors of finer and finer voxels, against closed forms."));
    m_pixel->setToolTip(tr("Errors of finer and finer pixels, against their mean."));
    m_extreme->setToolTip(
        tr("Very dense, very thin, empty, huge and broken scenes, each against a closed form or the "
           "reference."));
    m_run->setDefault(true);
    m_save->setAutoDefault(false);

    m_table->setHorizontalHeaderLabels(
        {tr("Case"), tr("Theory"), tr("Observed"), tr("Result"), tr("Reason")});
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setAlternatingRowColors(true);
    m_table->setWordWrap(false);
    m_table->setTabKeyNavigation(false);  // Tab goes on to the next control.
    m_table->verticalHeader()->hide();
    m_table->verticalHeader()->setDefaultSectionSize(m_table->fontMetrics().height() + 6);
    m_table->horizontalHeader()->setStretchLastSection(true);
    m_table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    constexpr int kWidths[] = {330, 190, 80, 60};
    for (int column = 0; column < kReason; ++column) m_table->setColumnWidth(column, kWidths[column]);

    auto* introduction = new QLabel(
        tr("Draws known fields on this machine and compares the order at which errors fall with theory. The "
           "views stay usable meanwhile. Each part takes up to a minute without a graphics card."),
        this);
    introduction->setWordWrap(true);
    auto* choices = new QHBoxLayout;
    choices->addWidget(new QLabel(tr("Refine:"), this));
    for (QCheckBox* box : {m_step, m_grid, m_pixel}) choices->addWidget(box);
    choices->addSpacing(16);
    choices->addWidget(m_extreme);
    choices->addStretch(1);
    choices->addWidget(m_run);
    m_summary->setWordWrap(true);
    m_summary->setTextFormat(Qt::PlainText);
    m_progress->setRange(0, 1000);
    m_progress->hide();
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_save, QDialogButtonBox::ActionRole);
    buttons->button(QDialogButtonBox::Close)->setAutoDefault(false);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* column = new QVBoxLayout(this);
    column->addWidget(introduction);
    column->addLayout(choices);
    column->addWidget(m_table, 1);
    column->addWidget(m_progress);
    column->addWidget(m_summary);
    column->addWidget(buttons);
    // The table was made before the button above it.
    setTabOrder(m_extreme, m_run);
    setTabOrder(m_run, m_table);
    resize(1080, 640);
}

accuracy::VerificationParts VerifyDialog::chosenParts() const {
    return {m_step->isChecked(), m_grid->isChecked(), m_pixel->isChecked(), m_extreme->isChecked()};
}

void VerifyDialog::runOrCancel() {
    if (m_runner.isRunning()) {
        m_runner.cancel();
        m_run->setEnabled(false);  // Until it has ended.
        return;
    }
    m_table->setRowCount(0);
    m_failed = 0;
    m_verification.reset();
    m_summary->clear();
    m_progress->setValue(0);
    m_since.start();
    m_runner.start(chosenParts());
    updateButtons();
}

void VerifyDialog::addRow(const accuracy::VerificationLine& line) {
    const int row = m_table->rowCount();
    m_table->insertRow(row);
    const QString texts[] = {QString::fromStdString(line.name), QString::fromStdString(line.theory),
                             QString::fromStdString(line.observed), line.passed ? tr("pass") : tr("FAIL"),
                             QString::fromStdString(line.reason)};
    for (int column = 0; column < kColumns; ++column) {
        auto* item = new QTableWidgetItem(texts[column]);
        item->setToolTip(texts[column]);
        m_table->setItem(row, column, item);
    }
    m_table->item(row, kResult)->setForeground(line.passed ? kPassed : kFailed);
    m_failed += line.passed ? 0 : 1;
    m_table->scrollToBottom();
}

QString VerifyDialog::countText() const {
    const int rows = m_table->rowCount();
    if (m_failed == 0) return tr("All %1 rows passed").arg(rows);
    return tr("%1 of %2 rows FAILED").arg(m_failed).arg(rows);
}

void VerifyDialog::finish(std::shared_ptr<const accuracy::Verification> verification, const Error* error) {
    if (m_isClosed) {
        deleteLater();
        return;
    }
    m_verification = std::move(verification);
    const QString seconds = QString::number(static_cast<double>(m_since.elapsed()) / 1000.0, 'f', 0);
    if (m_verification)
        m_summary->setText(tr("%1, in %2 s, on %3.")
                               .arg(countText(), seconds, QString::fromStdString(m_verification->driver)));
    else if (error->code == ErrorCode::Cancelled)
        m_summary->setText(m_table->rowCount() == 0
                               ? tr("Cancelled before the first row.")
                               : tr("Cancelled after %1 s. %2 until then.").arg(seconds, countText()));
    else
        m_summary->setText(QString::fromStdString(error->text()));
    updateButtons();
}

void VerifyDialog::updateButtons() {
    const bool isRunning = m_runner.isRunning();
    const accuracy::VerificationParts parts = chosenParts();
    for (QCheckBox* box : {m_step, m_grid, m_pixel, m_extreme}) box->setEnabled(!isRunning);
    m_run->setText(isRunning ? tr("&Cancel") : tr("&Run"));
    m_run->setEnabled(isRunning || parts.step || parts.grid || parts.pixel || parts.extreme);
    m_progress->setVisible(isRunning);
    m_save->setEnabled(m_verification != nullptr);
}

void VerifyDialog::saveReport() {
    const QString file = QFileDialog::getSaveFileName(this, tr("Save report"), QStringLiteral("verify.txt"),
                                                      tr("Text (*.txt);;JSON (*.json)"));
    if (file.isEmpty()) return;
    const Result<void> written = writeVerification(file.toStdString(), *m_verification);
    m_summary->setText(written ? tr("The report is in %1.").arg(file)
                               : QString::fromStdString(written.error().text()));
}

void VerifyDialog::done(int result) {
    if (m_runner.isRunning()) {
        m_isClosed = true;
        m_runner.cancel();
        setAttribute(Qt::WA_DeleteOnClose, false);
    }
    QDialog::done(result);
}

}  // namespace pellucid::app
