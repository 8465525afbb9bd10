// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/volume_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/desktop/theme.h"
#include "renderer/resize.h"

namespace pellucid::app {

namespace {

constexpr int kChannel = 3;   // After the three planes.
constexpr int kRestMs = 150;  // Longer than the pauses within a drag.
constexpr int kWheelEndMs = 500;
constexpr double kZoomDragPx = 150.0;  // As in the slice views.
constexpr double kWheelZoom = 1.15;
constexpr double kMinZoom = 0.02, kMaxZoom = 200.0;

}  // namespace

VolumeView::VolumeView(Document& document, RenderService& service, QWidget* parent)
    : ViewWidget(kChannel, document, service, parent) {
    m_refine.setSingleShot(true);
    m_endWheel.setSingleShot(true);
    m_endWheel.setInterval(kWheelEndMs);
    connect(&m_refine, &QTimer::timeout, this, [this] {
        if (!this->document().isEmpty())
            ask({.scene = shownScene(),
                 .priority = RenderService::Priority::Full,
                 .refines = true,
                 .chosen = m_chosen,
                 .refinesFrom = m_interaction.refinesFrom(m_shownInPassing)});
    });
    connect(&m_endWheel, &QTimer::timeout, &document, &Document::endGesture);
    connect(&document, &Document::replaced, this, [this] {
        m_askedScene = {};
        m_interaction = renderer::InteractionControl(m_interaction.targetMs());
        m_chosen.reset();
        m_isFinal = false;
    });
    connect(&document, &Document::sceneChanged, this, &VolumeView::refresh);
}

Scene VolumeView::shownScene() const {
    return volumeScene(document().scene(), pixelSize());
}

void VolumeView::refresh() {
    if (document().isEmpty() || !isVisible()) return;
    Scene scene = shownScene();
    // What is painted over a picture changes with it; painting at every move of a mouse would take time from
    // drawing.
    if (scene == m_askedScene) return update();
    m_askedScene = scene;
    m_isFinal = false;
    const glm::ivec2 full = scene.picture.size;
    const renderer::Passing passing = m_interaction.next(static_cast<double>(full.x) * full.y);
    scene.picture.size = renderer::reducedSize(full, passing.reduction);
    scene.quality = renderer::passingQuality(scene.quality, m_chosen, passing.stepTimes);
    // The picture's shape decides how the volume is framed; the small picture's is rounded, so it gets the
    // full one's.
    scene.camera.pose =
        resolvedPose(scene.camera, document().volume().grid(), static_cast<double>(width()) / height());
    m_refine.stop();
    m_sinceChange.start();
    ask({.scene = std::move(scene),
         .priority = RenderService::Priority::Interactive,
         .passing = passing,
         .shownSize = full});
}

void VolumeView::received(const RenderService::Reply& reply) {
    const bool isFull = reply.priority == RenderService::Priority::Full;
    m_isFinal = reply.error || (isFull && reply.isFinal);
    if (!reply.frame) return;
    if (reply.frame->chosen) m_chosen = reply.frame->chosen;
    if (reply.passingErrors) m_interaction.learned(*reply.passingErrors);
    if (!reply.passing) return;
    const glm::ivec2 size = reply.frame->image.size;
    const double drawMs = reply.frame->cost.gpuMs;
    m_interaction.took(*reply.passing, static_cast<double>(size.x) * size.y, drawMs, reply.totalMs - drawMs);
    m_shownInPassing = *reply.passing;
    // The full picture is asked for only now: as the newer request it would have taken the small one's place.
    if (isSettled()) m_refine.start(std::max(0, kRestMs - static_cast<int>(m_sinceChange.elapsed())));
}

void VolumeView::moveCamera(const char* name, const CameraPose& pose, double zoom) {
    document().change(name, name, [&](Scene& scene) {
        scene.camera.pose = pose;
        scene.camera.zoom = std::clamp(zoom, kMinZoom, kMaxZoom);
    });
}

void VolumeView::resetView() {
    setStandardView(document().scene().camera.view);
}

void VolumeView::setStandardView(AnatomicalView view) {
    static constexpr const char* kNames[] = {"View from anterior", "View from posterior",
                                             "View from left",     "View from right",
                                             "View from superior", "View from inferior"};
    document().change(kNames[static_cast<int>(view)], {}, [view](Scene& scene) {
        scene.camera.view = view;
        scene.camera.zoom = 1.0;
        scene.camera.pose.reset();
    });
}

void VolumeView::beginDrag(const QMouseEvent& event) {
    m_cameraAtPress = document().scene().camera;
    m_poseAtPress =
        editablePose(m_cameraAtPress, document().volume().grid(), static_cast<double>(width()) / height());
    m_flies = event.modifiers() & Qt::ControlModifier;
}

double VolumeView::angleAbout(QPointF position) const {
    const QPointF offset = position - QPointF(rect().center());
    return std::atan2(offset.y(), offset.x());
}

void VolumeView::continueDrag(QPointF position) {
    const QPointF moved = position - pressedAt();
    // Half a turn over the height of the view.
    const double perPixel = std::numbers::pi / height();
    const double zoom = m_cameraAtPress.zoom;
    switch (drag()) {
        case Drag::Primary:
            moveCamera("Rotate", rotated(m_poseAtPress, moved.x() * perPixel, -moved.y() * perPixel), zoom);
            return;
        case Drag::Roll:
            moveCamera("Roll", rolled(m_poseAtPress, angleAbout(position) - angleAbout(pressedAt())), zoom);
            return;
        case Drag::Pan: {
            const double mmPerPixel = visibleHeightMm(m_cameraAtPress, m_poseAtPress) / height();
            moveCamera("Pan", panned(m_poseAtPress, -moved.x() * mmPerPixel, moved.y() * mmPerPixel), zoom);
            return;
        }
        case Drag::Zoom: {
            const double factor = std::exp(-moved.y() / kZoomDragPx);
            if (m_flies)
                moveCamera("Fly", dollied(m_poseAtPress, 1.0 / factor), zoom);
            else
                moveCamera("Zoom", m_poseAtPress, zoom * factor);
            return;
        }
        case Drag::Crosshair:
        case Drag::None:
            return;
    }
}

void VolumeView::wheelEvent(QWheelEvent* event) {
    if (document().isEmpty()) return;
    const double factor = std::pow(kWheelZoom, event->angleDelta().y() / 120.0);
    const Camera& camera = document().scene().camera;
    const double aspect = static_cast<double>(width()) / height();
    const CameraPose pose = editablePose(camera, document().volume().grid(), aspect);
    if (event->modifiers() & Qt::ControlModifier)
        moveCamera("Fly", dollied(pose, 1.0 / factor), camera.zoom);
    else
        moveCamera("Zoom", pose, camera.zoom * factor);
    m_endWheel.start();
}

void VolumeView::keyPressEvent(QKeyEvent* event) {
    const bool isPlain = !(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::KeypadModifier));
    switch (isPlain ? event->key() : 0) {
        case Qt::Key_A:
            setStandardView(AnatomicalView::Anterior);
            return;
        case Qt::Key_P:
            setStandardView(AnatomicalView::Posterior);
            return;
        case Qt::Key_L:
            setStandardView(AnatomicalView::Left);
            return;
        case Qt::Key_R:
            // R alone resets, as in the slice views; the patient's right is Shift+R.
            event->modifiers() & Qt::ShiftModifier ? setStandardView(AnatomicalView::Right) : resetView();
            return;
        case Qt::Key_S:
            setStandardView(AnatomicalView::Superior);
            return;
        case Qt::Key_I:
            setStandardView(AnatomicalView::Inferior);
            return;
        default:
            ViewWidget::keyPressEvent(event);
    }
}

void VolumeView::paintOverlay(QPainter& painter) {
    if (!lastReply() || !lastReply()->frame) return;
    const auto& warnings = document().volume().info().warnings;
    if (warnings.empty()) return;
    const QRectF inside = QRectF(rect()).adjusted(8, 6, -8, -6);
    drawOverlayText(painter, inside, Qt::AlignLeft | Qt::AlignTop,
                    warnings.size() == 1 ? tr("1 warning about this scan")
                                         : tr("%1 warnings about this scan").arg(warnings.size()));
}

}  // namespace pellucid::app
