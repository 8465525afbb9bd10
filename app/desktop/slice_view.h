// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/desktop/view_widget.h"

namespace pellucid::app {

/// One of the three slice views. Left drag: window and level; middle or Shift+left: pan; right or Ctrl+wheel:
/// zoom; wheel, arrows, page keys: slices; Shift+move or Ctrl+left: crosshair.
class SliceView : public ViewWidget {
    Q_OBJECT

public:
    SliceView(Plane plane, Document& document, RenderService& service, QWidget* parent = nullptr);

    [[nodiscard]] Plane plane() const { return m_plane; }
    [[nodiscard]] const SlicePlacement& placement() const { return m_placement; }
    [[nodiscard]] Scene shownScene() const override;
    void resetView() override;
    void setShowsCrosshair(bool shows);

    /// Patient position in the slice under a position in logical pixels, and back.
    [[nodiscard]] glm::dvec3 patientAt(QPointF position) const;
    [[nodiscard]] QPointF positionOf(glm::dvec3 patientMm) const;
    /// What the status bar says of a position: value with unit, patient position, voxel index; empty outside
    /// the volume.
    [[nodiscard]] QString probeText(QPointF position) const;

protected:
    void refresh() override;
    void paintOverlay(QPainter& painter) override;
    Drag dragFor(const QMouseEvent& event) const override { return dragOf(event, Drag::Crosshair); }
    void beginDrag(const QMouseEvent& event) override;
    void continueDrag(QPointF position) override;

    void mouseMoveEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    void dragWindow(QPointF moved);
    void paintCrosshair(QPainter& painter) const;
    [[nodiscard]] RayFrame frame() const;
    [[nodiscard]] QString cornerText() const;

    Plane m_plane;
    SlicePlacement m_placement;
    bool m_showsCrosshair = true;
    Scene m_askedScene;
    Window m_windowAtPress;
    SlicePlacement m_placementAtPress;
    int m_wheelRest = 0;  ///< Eighths of a degree not yet turned into slices.
};

}  // namespace pellucid::app
