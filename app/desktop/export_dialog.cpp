// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/export_dialog.h"

#include <fmt/format.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>

#include "app/desktop/document.h"
#include "app/desktop/view_widget.h"
#include "io/image_file.h"
#include "scene/image.h"

namespace pellucid::app {

namespace {
constexpr int kChannel = 4;      // After the four views.
constexpr int kMaxSize = 16384;  // As Picture::size.
}  // namespace

Result<void> writePicture(const std::filesystem::path& file, const ImageF& image, const Scene& scene) {
    const std::string suffix = QString::fromStdString(file.extension().string()).toLower().toStdString();
    if (suffix == ".png")
        return io::writePng(file, quantise(image, scene.picture.transparent, scene.quality.dither));
    if (suffix == ".npy") return io::writeNpy(file, image);
    if (suffix == ".pfm") return io::writePfm(file, image);
    return fail(
        ErrorCode::InvalidArgument,
        fmt::format("The file name ends in \"{}\"; choose .png (8 bits), .npy or .pfm (float).", suffix));
}

ExportDialog::ExportDialog(const Document& document, RenderService& service, std::vector<Choice> choices,
                           QWidget* parent)
    : QDialog(parent),
      m_document(document),
      m_service(service),
      m_choices(std::move(choices)),
      m_view(new QComboBox(this)),
      m_width(new QSpinBox(this)),
      m_height(new QSpinBox(this)),
      m_transparent(new QCheckBox(tr("Transparent background"), this)),
      m_file(new QLineEdit(this)),
      m_progress(new QProgressBar(this)),
      m_message(new QLabel(this)),
      m_buttons(new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel, this)) {
    setWindowTitle(tr("Export picture"));
    setObjectName(QStringLiteral("exportDialog"));
    build(m_choices.front().view->shownScene());
    connect(m_buttons, &QDialogButtonBox::accepted, this, &ExportDialog::start);
    connect(m_buttons, &QDialogButtonBox::rejected, this, &ExportDialog::reject);
    connect(&service, &RenderService::replied, this, &ExportDialog::finish);
    connect(&service, &RenderService::exportProgressed, this,
            [this](double fraction) { m_progress->setValue(static_cast<int>(fraction * 100.0)); });
}

void ExportDialog::build(const Scene& first) {
    m_view->setObjectName(QStringLiteral("exportView"));
    m_width->setObjectName(QStringLiteral("exportWidth"));
    m_height->setObjectName(QStringLiteral("exportHeight"));
    m_transparent->setObjectName(QStringLiteral("exportTransparent"));
    m_file->setObjectName(QStringLiteral("exportFile"));
    m_message->setObjectName(QStringLiteral("exportMessage"));
    m_buttons->setObjectName(QStringLiteral("exportButtons"));
    for (const Choice& choice : m_choices) m_view->addItem(choice.name);
    for (QSpinBox* box : {m_width, m_height}) {
        box->setRange(1, kMaxSize);
        box->setSuffix(tr(" px"));
    }
    m_width->setValue(first.picture.size.x);
    m_height->setValue(first.picture.size.y);
    m_file->setText(QStringLiteral("picture.png"));
    m_message->setWordWrap(true);
    m_message->setTextFormat(Qt::PlainText);
    m_message->hide();
    m_progress->hide();
    auto* browseButton = new QPushButton(tr("Browse..."), this);
    connect(browseButton, &QPushButton::clicked, this, &ExportDialog::browse);

    auto* file = new QHBoxLayout;
    file->addWidget(m_file, 1);
    file->addWidget(browseButton);
    auto* size = new QHBoxLayout;
    size->addWidget(m_width);
    size->addWidget(new QLabel(QStringLiteral("x"), this));
    size->addWidget(m_height);
    size->addStretch(1);
    auto* form = new QFormLayout(this);
    form->addRow(tr("View"), m_view);
    form->addRow(tr("Size"), size);
    form->addRow(QString(), m_transparent);
    form->addRow(tr("File"), file);
    auto* hint = new QLabel(
        tr(".png holds 8 bits; .npy and .pfm hold the float values before rounding. Text on the views, the "
           "crosshair and the letters are not in the picture."),
        this);
    hint->setWordWrap(true);
    hint->setForegroundRole(QPalette::PlaceholderText);
    form->addRow(hint);
    form->addRow(m_progress);
    form->addRow(m_message);
    form->addRow(m_buttons);
    setMinimumWidth(460);
}

void ExportDialog::browse() {
    const QString file = QFileDialog::getSaveFileName(this, tr("Export picture"), m_file->text(),
                                                      tr("Pictures (*.png *.npy *.pfm)"));
    if (!file.isEmpty()) m_file->setText(file);
}

Scene ExportDialog::chosenScene() const {
    Scene scene = m_choices[static_cast<std::size_t>(m_view->currentIndex())].view->shownScene();
    scene.picture.size = {m_width->value(), m_height->value()};
    scene.picture.transparent = m_transparent->isChecked();
    return scene;
}

void ExportDialog::start() {
    m_message->hide();
    m_scene = chosenScene();
    setBusy(true);
    m_number =
        m_service.request({kChannel, m_scene, m_document.volumes(), RenderService::Priority::Export, false});
}

void ExportDialog::finish(const RenderService::Reply& reply) {
    if (reply.channel != kChannel || reply.number != m_number) return;
    m_number = 0;
    setBusy(false);
    const std::filesystem::path file = m_file->text().toStdString();
    const Result<void> written =
        reply.error ? tl::unexpected(*reply.error) : writePicture(file, reply.frame->image, m_scene);
    if (written) {
        Q_EMIT exported(m_file->text());
        accept();
        return;
    }
    m_message->setText(QString::fromStdString(written.error().text()));
    m_message->show();
}

void ExportDialog::setBusy(bool busy) {
    m_progress->setValue(0);
    m_progress->setVisible(busy);
    m_buttons->button(QDialogButtonBox::Save)->setEnabled(!busy);
}

void ExportDialog::reject() {
    if (m_number == 0) return QDialog::reject();
    m_service.cancel(kChannel);
    m_number = 0;
    setBusy(false);
}

}  // namespace pellucid::app
