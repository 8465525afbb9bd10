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
#include "renderer/refinement.h"
#include "scene/names.h"

namespace pellucid::app {

namespace {

QColor shown(glm::dvec3 color) {
    return QColor::fromRgbF(static_cast<float>(color.r), static_cast<float>(color.g),
                            static_cast<float>(color.b));
}

constexpr int kByError = 0, kByStep = 1;  // Entries of m_unit.
constexpr double kLeastLevels = 0.1, kMostLevels = 20.0;
constexpr double kLeastFrameMs = 10.0, kMostFrameMs = 1000.0;
constexpr double kLeastStep = 0.01, kMostStep = 16.0;  // Voxels; what is chosen for an error lies in here.

QString textOf(Integrator integrator) {
    switch (integrator) {
        case Integrator::Riemann:
            return QualityPanel::tr("Riemann sum (historical)");
        case Integrator::Exponential:
            return QualityPanel::tr("Exponential");
        case Integrator::Trapezoid:
            return QualityPanel::tr("Trapezoid");
        case Integrator::Simpson:
            return QualityPanel::tr("Simpson");
        case Integrator::GaussLegendre:
            return QualityPanel::tr("Gauss-Legendre");
        case Integrator::Preintegrated2D:
            return QualityPanel::tr("Pre-integrated, one length");
        case Integrator::Preintegrated3D:
            return QualityPanel::tr("Pre-integrated, all lengths");
        case Integrator::IntegralFunctions:
            return QualityPanel::tr("Running integrals");
        case Integrator::Adaptive:
            return QualityPanel::tr("Adaptive steps");
        case Integrator::Importance:
            break;
    }
    return QualityPanel::tr("Steps by importance");
}

}  // namespace

QualityPanel::QualityPanel(Document& document, QWidget* parent)
    : QGroupBox(tr("Picture"), parent),
      m_document(document),
      m_form(new QFormLayout(this)),
      m_filter(new QComboBox(this)),
      m_unit(new QComboBox(this)),
      m_tolerance(new NumberControl(kLeastLevels, kMostLevels, 1, this)),
      m_norm(new QComboBox(this)),
      m_step(new NumberControl(kLeastStep, kMostStep, 2, this)),
      m_integrator(new QComboBox(this)),
      m_space(new QComboBox(this)),
      m_projection(new QComboBox(this)),
      m_fov(new NumberControl(5.0, 90.0, 0, this)),
      m_frameTarget(new NumberControl(kLeastFrameMs, kMostFrameMs, 0, this)),
      m_background(new QPushButton(tr("Choose..."), this)),
      m_dither(new QCheckBox(tr("Dither to 8 bits"), this)) {
    setObjectName(QStringLiteral("qualityPanel"));
    m_filter->setObjectName(QStringLiteral("filter"));
    m_unit->setObjectName(QStringLiteral("qualityUnit"));
    m_tolerance->setObjectName(QStringLiteral("tolerance"));
    m_norm->setObjectName(QStringLiteral("toleranceNorm"));
    m_step->setObjectName(QStringLiteral("step"));
    m_integrator->setObjectName(QStringLiteral("integrator"));
    m_space->setObjectName(QStringLiteral("space"));
    m_projection->setObjectName(QStringLiteral("projection"));
    m_fov->setObjectName(QStringLiteral("fov"));
    m_frameTarget->setObjectName(QStringLiteral("frameTarget"));
    m_background->setObjectName(QStringLiteral("background"));
    m_dither->setObjectName(QStringLiteral("dither"));
    build();
    connectEdits();
    connectQuality();
    connect(&document, &Document::sceneChanged, this, &QualityPanel::sync);
    connect(&document, &Document::replaced, this, [this] { m_chosen.reset(); });
}

void QualityPanel::build() {
    m_filter->addItems({tr("Nearest voxel"), tr("Trilinear"), tr("Tricubic B-spline"), tr("Catmull-Rom"),
                        tr("Lanczos 3 (slow)"), tr("Trilinear in full precision"),
                        tr("Tricubic B-spline, recursive"), tr("Tricubic B-spline, weight table")});
    m_unit->addItems({tr("By error"), tr("By step")});
    m_norm->addItems({tr("On average (RMS)"), tr("Anywhere (maximum)")});
    for (const auto& integrator : enumNames<Integrator>()) m_integrator->addItem(textOf(integrator.value));
    m_space->addItems({tr("As shown"), tr("Linear light")});
    m_projection->addItems({tr("Perspective"), tr("Orthographic")});
    m_tolerance->setLogarithmic();
    m_step->setLogarithmic();
    m_frameTarget->setLogarithmic();
    m_frameTarget->setSuffix(tr(" ms"));
    m_fov->setSuffix(QString(QChar(0xb0)));
    m_filter->setToolTip(tr("How values between voxels are found, in slices and in 3D."));
    m_unit->setToolTip(
        tr("By error: say how wrong the picture may be; the cheapest settings that keep to it are found by "
           "trying. By step: set them yourself."));
    m_tolerance->setToolTip(
        tr("The error allowed, in grey levels: 255 are the whole range, 1 is what 8 bits just show."));
    m_norm->setToolTip(
        tr("What must stay below: the root mean square over the picture, or every pixel. The second takes "
           "longer, "
           "since all pixels are measured."));
    m_step->setToolTip(tr("Distance of two samples on a ray, in units of the smallest voxel spacing."));
    m_integrator->setToolTip(tr("How the light between two samples is summed (see equations.md)."));
    m_frameTarget->setToolTip(
        tr("How long a picture may take while something moves. Size and steps follow from it; the brightness "
           "stays. Kept for all scans."));
    m_space->setToolTip(
        tr("As shown: colours are blended the way they look, as most programs do. Linear light: as light "
           "adds up."));
    m_form->addRow(tr("Interpolation"), m_filter);
    m_form->addRow(tr("Quality"), m_unit);
    m_form->addRow(tr("Grey levels"), m_tolerance);
    m_form->addRow(tr("Measured"), m_norm);
    m_form->addRow(tr("Step (voxels)"), m_step);
    m_form->addRow(tr("Integrator"), m_integrator);
    m_form->addRow(tr("While moving"), m_frameTarget);
    m_form->addRow(tr("Blending"), m_space);
    m_form->addRow(tr("Projection"), m_projection);
    m_form->addRow(tr("View angle"), m_fov);
    m_form->addRow(tr("Background"), m_background);
    m_form->addRow(m_dither);
}

void QualityPanel::connectEdits() {
    connect(m_filter, &QComboBox::activated, this, [this](int index) {
        m_document.changeItem("Interpolation: " + m_filter->itemText(index).toStdString(), {},
                              [&](VolumeItem& item) { item.filter = static_cast<Filter>(index); });
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
    connect(m_fov, &NumberControl::editEnded, &m_document, &Document::endGesture);
}

void QualityPanel::connectQuality() {
    connect(m_unit, &QComboBox::activated, this, &QualityPanel::chooseUnit);
    connect(m_tolerance, &NumberControl::edited, this, [this](double levels) {
        m_document.change("Error allowed", "error allowed",
                          [&](Scene& scene) { scene.quality.toleranceGreyLevels = levels; });
    });
    connect(m_norm, &QComboBox::activated, this, [this](int index) {
        m_document.change("Error measured: " + m_norm->itemText(index).toStdString(), {},
                          [&](Scene& scene) { scene.quality.toleranceNorm = static_cast<ErrorNorm>(index); });
    });
    connect(m_step, &NumberControl::edited, this, [this](double step) {
        m_document.change("Step", "step", [&](Scene& scene) {
            scene.quality.stepVoxels = step;
            scene.quality.stepMm.reset();
        });
    });
    connect(m_integrator, &QComboBox::activated, this, [this](int index) {
        m_document.change("Integrator: " + m_integrator->itemText(index).toStdString(), {},
                          [&](Scene& scene) { scene.quality.integrator = static_cast<Integrator>(index); });
    });
    connect(m_frameTarget, &NumberControl::edited, this, &QualityPanel::frameTargetEdited);
    connect(m_tolerance, &NumberControl::editEnded, &m_document, &Document::endGesture);
    connect(m_step, &NumberControl::editEnded, &m_document, &Document::endGesture);
}

void QualityPanel::setFrameTargetMs(double ms) {
    m_frameTarget->setValue(ms);
}

void QualityPanel::chooseUnit(int index) {
    if (index == kByError) {
        m_document.change("Quality by error", {}, [](Scene& scene) {
            scene.quality.automatic = true;
            scene.quality.toleranceGreyLevels = toleranceGreyLevels(scene.quality);
        });
        return;
    }
    m_document.change("Quality by step", {}, [this](Scene& scene) {
        // The picture stays as it is: what was chosen for the error is stated from now on.
        if (scene.quality.automatic) scene.quality = renderer::statedQuality(scene.quality, m_chosen);
    });
}

void QualityPanel::sync() {
    const Scene& scene = m_document.scene();
    m_filter->setCurrentIndex(static_cast<int>(m_document.item().filter));
    syncQuality();
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

void QualityPanel::syncQuality() {
    const Scene& scene = m_document.scene();
    const Quality& quality = scene.quality;
    m_unit->setCurrentIndex(quality.automatic ? kByError : kByStep);
    m_tolerance->setValue(toleranceGreyLevels(quality));
    m_norm->setCurrentIndex(static_cast<int>(quality.toleranceNorm));
    m_step->setValue(quality.stepMm ? *quality.stepMm / smallestSpacingMm(m_document.volume().grid())
                                    : quality.stepVoxels);
    m_integrator->setCurrentIndex(static_cast<int>(quality.integrator));

    const bool followsTolerance = usesIntegrator(scene.mode) && keepsTolerance(quality.integrator);
    m_form->setRowVisible(m_tolerance, quality.automatic || followsTolerance);
    m_form->setRowVisible(m_norm, quality.automatic);
    m_form->setRowVisible(m_step, !quality.automatic);
    m_form->setRowVisible(m_integrator, !quality.automatic && usesIntegrator(scene.mode));
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
