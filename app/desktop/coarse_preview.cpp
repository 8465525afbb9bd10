// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/coarse_preview.h"

#include <QPainter>

#include "app/desktop/theme.h"
#include "io/load.h"
#include "renderer/resize.h"

namespace pellucid::app {

namespace {

constexpr int kChannel = 5;  // After the views and the export.
// The files are decoded at the same time, so few rays; a ray a coarse voxel or so.
constexpr double kReduction = 4.0;
constexpr double kStepVoxels = 1.0;

}  // namespace

Scene sceneOfCoarse(const VolumePtr& coarse) {
    Scene scene;
    scene.unitLengthMm = meanSpacingMm(coarse->grid()) / io::kCoarseEvery;
    scene.quality.stepVoxels = kStepVoxels;
    return completed(scene, {coarse});
}

CoarsePreview::CoarsePreview(RenderService& service, QWidget* parent) : QWidget(parent), m_service(service) {
    setObjectName(QStringLiteral("coarsePreview"));
    setAttribute(Qt::WA_OpaquePaintEvent);
    hide();
    connect(&service, &RenderService::replied, this, &CoarsePreview::take);
}

void CoarsePreview::begin(const VolumePtr& coarse, const QRect& place) {
    setGeometry(place);
    const glm::ivec2 size =
        glm::max(glm::ivec2(glm::dvec2(place.width(), place.height()) * devicePixelRatioF()), glm::ivec2(1));
    Scene scene = sceneOfCoarse(coarse);
    scene.picture.size = renderer::reducedSize(size, kReduction);
    m_asked = m_service.request({.channel = kChannel,
                                 .scene = std::move(scene),
                                 .volumes = {coarse},
                                 .priority = RenderService::Priority::Interactive,
                                 .shownSize = size});
}

void CoarsePreview::take(const RenderService::Reply& reply) {
    if (m_asked == 0 || reply.number != m_asked || !reply.frame) return;
    m_picture = reply.picture;
    show();
    raise();
    update();
}

void CoarsePreview::end() {
    if (m_asked == 0) return;
    m_asked = 0;
    m_service.cancel(kChannel);
    m_picture = {};
    hide();
}

void CoarsePreview::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.drawImage(QRectF(rect()), m_picture);
    drawOverlayText(painter, QRectF(rect()).adjusted(8, 6, -8, -6), Qt::AlignLeft | Qt::AlignTop,
                    tr("Coarse preview: one of 64 voxels. The whole follows."));
}

}  // namespace pellucid::app
