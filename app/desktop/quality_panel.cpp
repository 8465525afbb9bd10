// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/quality_panel.h"

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QFormLayout>
#include <QPixmap>
#include <QPushButton>

#include "app/desktop/number_control.h"

namespace pellucid::app {

namespace {

QColor shown(glm::dvec3 color) {
    return QColor::fromRgbF(static_cast<float>(color.r), static_cast<float>(color.g),
                            static_cast<float>(color.b));
}

}  // namespace

QualityPanel::QualityPanel(Document& document, QWidget* parent)
    : QGroupBox(tr("Picture"), parent),
      m_document(document),
      m_form(new QFormLayout(this)),
      m_filter(new QComboBox(this)),
      m_step(new NumberControl(0.05, 2.0, 2, this)),
      m_space(new QComboBox(this)),
      m_projection(new QComboBox(this)),
      m_fov(new NumberControl(5.0, 90.0, 0, this)),
      m_background(new QPushButton(tr("Choose..."), this)),
      m_dither(new QCheckBox(tr("Dither to 8 bits"), this)) {
    setObjectName(QStringLiteral("qualityPanel"));
    m_filter->setObjectName(QStringLiteral("filter"));
    m_step->setObjectName(QStringLiteral("step"));
    m_space->setObjectName(QStringLiteral("space"));
    m_projection->setObjectName(QStringLiteral("projection"));
    m_fov->setObjectName(QStringLiteral("fov"));
    m_background->setObjectName(QStringLiteral("background"));
    m_dither->setObjectName(QStringLiteral("dither"));
    m_filter->addItems({tr("Nearest voxel"), tr("Trilinear"), tr("Tricubic B-spline"), tr("Catmull-Rom"),
                        tr("Lanczos 3 (slow)"), tr("Trilinear in full precision"),
                        tr("Tricubic B-spline, recursive"), tr("Tricubic B-spline, weight table")});
    m_space->addItems({tr("As shown"), tr("Linear light")});
    m_projection->addItems({tr("Perspective"), tr("Orthographic")});
    m_filter->setToolTip(tr("How values between voxels are found, in slices and in 3D."));
    m_step->setToolTip(tr("Distance of two samples on a ray, in units of the smallest voxel spacing."));
    m_space->setToolTip(
        tr("As shown: colours are blended the way they look, as most programs do. Linear light: as light "
           "adds up."));
    m_form->addRow(tr("Interpolation"), m_filter);
    m_form->addRow(tr("Step (voxels)"), m_step);
    m_form->addRow(tr("Blending"), m_space);
    m_form->addRow(tr("Projection"), m_projection);
    m_form->addRow(tr("View angle"), m_fov);
    m_form->addRow(tr("Background"), m_background);
    m_form->addRow(m_dither);
    m_fov->setSuffix(QString(QChar(0xb0)));
    connectEdits();
    connect(&document, &Document::sceneChanged, this, &QualityPanel::sync);
}

void QualityPanel::connectEdits() {
    connect(m_filter, &QComboBox::activated, this, [this](int index) {
        m_document.changeItem("Interpolation: " + m_filter->itemText(index).toStdString(), {},
                              [&](VolumeItem& item) { item.filter = static_cast<Filter>(index); });
    });
    connect(m_step, &NumberControl::edited, this, [this](double step) {
        m_document.change("Step", "step", [&](Scene& scene) {
            scene.quality.stepVoxels = step;
            scene.quality.stepMm.reset();
        });
    });
    connect(m_space, &QComboBox::activated, this, [this](int index) {
        m_document.change("Blending", {},
                          [&](Scene& scene) { scene.space = static_cast<CompositingSpace>(index); });
    });
    connect(m_projection, &QComboBox::activated, this, [this](int index) {
        m_document.change("Projection", {},
                          [&](Scene& scene) { scene.camera.projection = static_cast<Projection>(index); });
    });
    connect(m_fov, &NumberControl::edited, this, [this](double angle) {
        m_document.change("View angle", "view angle", [&](Scene& scene) { scene.camera.fovDeg = angle; });
    });
    connect(m_dither, &QCheckBox::clicked, this, [this](bool on) {
        m_document.change("Dither", {}, [&](Scene& scene) { scene.quality.dither = on; });
    });
    connect(m_background, &QPushButton::clicked, this, &QualityPanel::pickBackground);
    connect(m_step, &NumberControl::editEnded, &m_document, &Document::endGesture);
    connect(m_fov, &NumberControl::editEnded, &m_document, &Document::endGesture);
}

void QualityPanel::sync() {
    const Scene& scene = m_document.scene();
    m_filter->setCurrentIndex(static_cast<int>(m_document.item().filter));
    m_step->setValue(scene.quality.stepMm
                         ? *scene.quality.stepMm / smallestSpacingMm(m_document.volume().grid())
                         : scene.quality.stepVoxels);
    m_space->setCurrentIndex(static_cast<int>(scene.space));
    m_projection->setCurrentIndex(static_cast<int>(scene.camera.projection));
    m_fov->setValue(scene.camera.fovDeg);
    m_dither->setChecked(scene.quality.dither);
    QPixmap swatch(16, 16);
    swatch.fill(shown(scene.picture.background));
    m_background->setIcon(swatch);

    m_form->setRowVisible(m_space, usesTransferFunction(scene.mode));
    m_form->setRowVisible(m_fov, scene.camera.projection == Projection::Perspective);
}

void QualityPanel::pickBackground() {
    const QColor color = QColorDialog::getColor(shown(m_document.scene().picture.background), this,
                                                tr("Background of the 3D view"));
    if (!color.isValid()) return;
    m_document.change("Background", {}, [&](Scene& scene) {
        scene.picture.background = {color.red() / 255.0, color.green() / 255.0, color.blue() / 255.0};
    });
}

}  // namespace pellucid::app
