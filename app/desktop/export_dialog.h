// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>
#include <filesystem>

#include "app/desktop/render_service.h"

class QCheckBox;
class QComboBox;
class QDialogButtonBox;
class QLineEdit;
class QProgressBar;
class QSpinBox;
class QLabel;

namespace pellucid::app {

class Document;
class ViewFrame;
class ViewWidget;

/// Writes what a view shows at any size, drawn by the same renderer: PNG (8 bits), .npy or .pfm (float).
class ExportDialog : public QDialog {
    Q_OBJECT

public:
    /// `views` with their names; the first is offered. All outlive the dialog.
    struct Choice {
        QString name;
        const ViewWidget* view;
    };
    ExportDialog(const Document& document, RenderService& service, std::vector<Choice> choices,
                 QWidget* parent = nullptr);

    /// The scene that would be drawn for the present settings.
    [[nodiscard]] Scene chosenScene() const;

Q_SIGNALS:
    void exported(const QString& file);

private:
    void build(const Scene& first);
    void browse();
    void start();
    void finish(const RenderService::Reply& reply);
    void setBusy(bool busy);
    void reject() override;

    const Document& m_document;
    RenderService& m_service;
    std::vector<Choice> m_choices;
    QComboBox* m_view;
    QSpinBox* m_width;
    QSpinBox* m_height;
    QCheckBox* m_transparent;
    QLineEdit* m_file;
    QProgressBar* m_progress;
    QLabel* m_message;
    QDialogButtonBox* m_buttons;
    Scene m_scene;               ///< Being drawn.
    std::uint64_t m_number = 0;  ///< Of the running request, 0 without one.
};

/// Writes a frame in the format that the file's name asks for. Errors: InvalidArgument for another name,
/// WriteFailed.
[[nodiscard]] Result<void> writePicture(const std::filesystem::path& file, const ImageF& image,
                                        const Scene& scene);

}  // namespace pellucid::app
