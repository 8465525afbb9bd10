// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QElapsedTimer>
#include <QTimer>

#include "app/desktop/view_widget.h"
#include "renderer/interaction.h"

namespace pellucid::app {

/// The 3D view: the document's scene. Left drag: rotate about the target; middle or Shift+left: pan; right
/// drag or wheel: zoom; Ctrl+right or Ctrl+wheel: fly towards the target; Ctrl+left: roll; A P L R S I and
/// keypad 1 3 7: standard views. A change shows a picture at once, with as many rays and samples as the frame
/// time allows; when the hand rests, the full size with ever smaller steps, and at last its error.
class VolumeView : public ViewWidget {
    Q_OBJECT

public:
    VolumeView(Document& document, RenderService& service, QWidget* parent = nullptr);

    [[nodiscard]] Scene shownScene() const override;
    void resetView() override;
    void setStandardView(AnatomicalView view);
    /// True when the full picture of the scene is shown and its error is known.
    [[nodiscard]] bool isComplete() const { return isSettled() && m_isFinal; }
    /// What decides how pictures are drawn while the scene moves.
    [[nodiscard]] const renderer::InteractionControl& interaction() const { return m_interaction; }
    /// How long a picture may take while the scene moves, > 0.
    void setFrameTargetMs(double ms) { m_interaction.setTargetMs(ms); }

protected:
    void refresh() override;
    void paintOverlay(QPainter& painter) override;
    Drag dragFor(const QMouseEvent& event) const override { return dragOf(event, Drag::Roll); }
    void beginDrag(const QMouseEvent& event) override;
    void continueDrag(QPointF position) override;
    void received(const RenderService::Reply& reply) override;

    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void moveCamera(const char* name, const CameraPose& pose, double zoom);
    [[nodiscard]] double angleAbout(QPointF position) const;

    QTimer m_refine;    ///< Single shot; not running while nothing changes.
    QTimer m_endWheel;  ///< Single shot; ends the wheel's gesture.
    Scene m_askedScene;
    QElapsedTimer m_sinceChange;
    bool m_isFinal = false;  ///< The newest answer is the last of a full picture, or that there is none.
    renderer::InteractionControl m_interaction{renderer::defaultFrameTargetMs(true)};
    renderer::Passing m_shownInPassing;  ///< Of the newest picture in passing.
    std::optional<Quality> m_chosen;     ///< By the renderer, for the last picture of automatic quality.
    Camera m_cameraAtPress;
    CameraPose m_poseAtPress;
    bool m_flies = false;
};

}  // namespace pellucid::app
