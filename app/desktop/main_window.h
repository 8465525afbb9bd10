// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QMainWindow>
#include <filesystem>
#include <vector>

#include "app/desktop/document.h"
#include "app/desktop/loader.h"
#include "app/desktop/render_service.h"

class QLabel;
class QMenu;
class QToolButton;

namespace pellucid::app {

class CoarsePreview;
class LoadBar;
class MessageBar;
class QualityPanel;
class SliceView;
class ViewFrame;
class ViewWidget;
class VolumeView;

/// The desktop: four linked views, panels, menus, and one document. What it shows comes from the document;
/// what the user does goes to it.
class MainWindow : public QMainWindow {
    Q_OBJECT

public:
    explicit MainWindow(QWidget* parent = nullptr);
    ~MainWindow() override;

    /// A scene file, or files and folders of one scan. Runs on another thread; on failure the window says why
    /// and keeps what it shows.
    void openPaths(const std::vector<std::filesystem::path>& paths, const io::LoadOptions& options = {});

    /// Shows what has been opened, or was made in memory, in place of what is shown.
    void showScan(OpenedScan scan);

    [[nodiscard]] Document& document() { return m_document; }
    [[nodiscard]] Loader& loader() { return m_loader; }
    [[nodiscard]] RenderService& renderService() { return m_service; }

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    // main_window.cpp: what is in the window, and what follows from events.
    void buildViews();
    void buildPanels();
    void buildStatusBar();
    void connectLoader();
    void askForSeries(const std::vector<io::DicomSeries>& series,
                      const std::vector<std::filesystem::path>& paths);
    void toggleMaximised(ViewFrame* frame);
    void showCost(const ViewWidget* view, const RenderService::Reply& reply);
    void updateTitle();
    void applyWindowKey(int key);
    void setFrameTargetMs(double ms);

    // main_window_actions.cpp: menus and what they do.
    void buildActions();
    void buildFileMenu();
    void buildEditMenu();
    void buildViewMenu();
    void buildWindowMenu();
    void buildHelpMenu();
    QAction* addTo(QMenu* menu, const char* objectName, const QString& text, const QKeySequence& key = {});
    void openFiles();
    void openFolder();
    void rememberRecent(const std::vector<std::filesystem::path>& paths);
    void fillRecentMenu();
    void fillWindowMenu();
    bool saveScene();
    bool saveSceneAs();
    bool saveSceneTo(const std::filesystem::path& file);
    /// Asks about changes of a scene file that are not saved; false when the user wants to stay.
    bool mayLeave();
    void showExport();
    void showPlan();
    void showVerify();
    void showInformation();
    void showKeys();
    void showAbout();
    void updateActions();

    Document m_document;
    RenderService m_service;
    Loader m_loader;

    MessageBar* m_messages = nullptr;
    QualityPanel* m_qualityPanel = nullptr;
    LoadBar* m_loadBar = nullptr;
    CoarsePreview* m_preview = nullptr;
    QLabel* m_welcome = nullptr;
    QWidget* m_views = nullptr;
    std::vector<ViewFrame*> m_frames;
    std::vector<SliceView*> m_slices;
    VolumeView* m_volumeView = nullptr;
    ViewFrame* m_maximised = nullptr;
    QLabel* m_probe = nullptr;
    QLabel* m_cost = nullptr;
    QToolButton* m_planButton = nullptr;
    QString m_device;
    QMenu* m_recentMenu = nullptr;
    QMenu* m_windowMenu = nullptr;
    QMenu* m_viewMenu = nullptr;
    QAction* m_undoAction = nullptr;
    QAction* m_redoAction = nullptr;
    std::vector<QAction*> m_needDocument;  ///< Disabled while nothing is open.
};

}  // namespace pellucid::app
