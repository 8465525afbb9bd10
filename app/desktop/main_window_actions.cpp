// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The main window's menus and what their entries do.
#include <fmt/format.h>

#include <QAction>
#include <QApplication>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QFontDatabase>
#include <QMenuBar>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QSettings>
#include <QToolBar>
#include <QVBoxLayout>

#include "app/desktop/export_dialog.h"
#include "app/desktop/main_window.h"
#include "app/desktop/message_bar.h"
#include "app/desktop/slice_view.h"
#include "app/desktop/verify_dialog.h"
#include "app/desktop/view_frame.h"
#include "app/desktop/volume_view.h"
#include "app/desktop/window_panel.h"
#include "io/scene_file.h"
#include "renderer/plan/plan.h"

namespace pellucid::app {

namespace {

constexpr int kMaxRecent = 8;
const QString kRecentKey = QStringLiteral("recent");

constexpr const char* kKeysText =
    "Slices\n"
    "  left drag              window (across) and level (up: brighter)\n"
    "  wheel, Up / Down       next or previous slice; Page Up / Page Down: ten\n"
    "  middle, Shift+left     move the picture\n"
    "  right drag, Ctrl+wheel zoom\n"
    "  Shift+move, Ctrl+left  crosshair to the cursor; the other views follow\n"
    "  double-click           one view alone, and back\n"
    "  R                      reset the view\n\n"
    "3D\n"
    "  left drag              rotate\n"
    "  middle, Shift+left     move\n"
    "  right drag, wheel      zoom; with Ctrl: fly towards the target\n"
    "  Ctrl+left              roll\n"
    "  A P L S I, Shift+R     from anterior, posterior, left, superior, inferior, right\n"
    "  keypad 1, 3, 7         from anterior, left, superior; with Shift from the other side\n"
    "  R                      reset the view\n\n"
    "Everywhere\n"
    "  1 ... 9                CT windows (see the menu Window), 0: full range\n"
    "  Ctrl+Z, Ctrl+Shift+Z   undo, redo\n"
    "  Ctrl+E                 export a picture\n";

void showText(QWidget* parent, const char* objectName, const QString& title, const QString& text,
              QSize size) {
    auto* dialog = new QDialog(parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setObjectName(QLatin1String(objectName));
    dialog->setWindowTitle(title);
    auto* edit = new QPlainTextEdit(text, dialog);
    edit->setObjectName(QStringLiteral("text"));
    edit->setReadOnly(true);
    edit->setLineWrapMode(QPlainTextEdit::NoWrap);
    edit->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto* layout = new QVBoxLayout(dialog);
    layout->addWidget(edit, 1);
    layout->addWidget(buttons);
    dialog->resize(size);
    dialog->show();
}

}  // namespace

QAction* MainWindow::addTo(QMenu* menu, const char* objectName, const QString& text,
                           const QKeySequence& key) {
    QAction* action = menu->addAction(text);
    action->setObjectName(QLatin1String(objectName));
    if (!key.isEmpty()) action->setShortcut(key);
    return action;
}

void MainWindow::buildActions() {
    buildFileMenu();
    buildEditMenu();
    buildViewMenu();
    buildWindowMenu();
    buildHelpMenu();
    auto* bar = addToolBar(tr("Tools"));
    bar->setObjectName(QStringLiteral("tools"));
    bar->setMovable(false);
    for (const char* action : {"openFolder", "openFiles", "undo", "redo", "resetViews", "export"})
        bar->addAction(findChild<QAction*>(QLatin1String(action)));
    m_viewMenu->addSeparator();
    m_viewMenu->addAction(findChild<QDockWidget*>(QStringLiteral("settingsDock"))->toggleViewAction());
    connect(&m_document, &Document::undoChanged, this, &MainWindow::updateActions);
    connect(&m_document, &Document::replaced, this, &MainWindow::fillWindowMenu);
    updateActions();
}

void MainWindow::buildFileMenu() {
    QMenu* menu = menuBar()->addMenu(tr("&File"));
    connect(addTo(menu, "openFiles", tr("&Open files..."), QKeySequence::Open), &QAction::triggered, this,
            &MainWindow::openFiles);
    connect(addTo(menu, "openFolder", tr("Open &folder..."), QKeySequence(tr("Ctrl+Shift+O"))),
            &QAction::triggered, this, &MainWindow::openFolder);
    m_recentMenu = menu->addMenu(tr("Open &recent"));
    m_recentMenu->setObjectName(QStringLiteral("recentMenu"));
    connect(m_recentMenu, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
    menu->addSeparator();
    QAction* save = addTo(menu, "saveScene", tr("&Save scene"), QKeySequence::Save);
    QAction* saveAs = addTo(menu, "saveSceneAs", tr("Save scene &as..."), QKeySequence::SaveAs);
    menu->addSeparator();
    QAction* information =
        addTo(menu, "information", tr("&Information on the scan..."), QKeySequence(tr("Ctrl+I")));
    QAction* exportPicture = addTo(menu, "export", tr("&Export picture..."), QKeySequence(tr("Ctrl+E")));
    menu->addSeparator();
    connect(addTo(menu, "quit", tr("&Quit"), QKeySequence::Quit), &QAction::triggered, this, &QWidget::close);
    connect(save, &QAction::triggered, this, &MainWindow::saveScene);
    connect(saveAs, &QAction::triggered, this, &MainWindow::saveSceneAs);
    connect(exportPicture, &QAction::triggered, this, &MainWindow::showExport);
    connect(information, &QAction::triggered, this, &MainWindow::showInformation);
    m_needDocument.insert(m_needDocument.end(), {save, saveAs, information, exportPicture});
}

void MainWindow::buildEditMenu() {
    QMenu* menu = menuBar()->addMenu(tr("&Edit"));
    m_undoAction = addTo(menu, "undo", tr("Undo"), QKeySequence(tr("Ctrl+Z")));
    m_redoAction = addTo(menu, "redo", tr("Redo"), QKeySequence(tr("Ctrl+Shift+Z")));
    connect(m_undoAction, &QAction::triggered, &m_document, &Document::undo);
    connect(m_redoAction, &QAction::triggered, &m_document, &Document::redo);
}

void MainWindow::buildViewMenu() {
    m_viewMenu = menuBar()->addMenu(tr("&View"));
    QAction* reset = addTo(m_viewMenu, "resetViews", tr("&Reset views"), QKeySequence(tr("Ctrl+0")));
    connect(reset, &QAction::triggered, this, [this] {
        for (ViewFrame* frame : m_frames) frame->view()->resetView();
    });
    m_needDocument.push_back(reset);
    QAction* crosshair = addTo(m_viewMenu, "showCrosshair", tr("&Crosshair"), QKeySequence(tr("H")));
    crosshair->setCheckable(true);
    crosshair->setChecked(true);
    connect(crosshair, &QAction::toggled, this, [this](bool on) {
        for (SliceView* view : m_slices) view->setShowsCrosshair(on);
    });
    QAction* text = addTo(m_viewMenu, "showText", tr("&Text on the views"), QKeySequence(tr("T")));
    text->setCheckable(true);
    text->setChecked(true);
    connect(text, &QAction::toggled, this, [this](bool on) {
        for (ViewFrame* frame : m_frames) frame->view()->setShowsOverlay(on);
    });
}

void MainWindow::buildWindowMenu() {
    m_windowMenu = menuBar()->addMenu(tr("&Window"));
    m_windowMenu->setObjectName(QStringLiteral("windowMenu"));
    m_needDocument.push_back(m_windowMenu->menuAction());
}

void MainWindow::fillWindowMenu() {
    m_windowMenu->clear();
    const auto windows = windowsFor(m_document.volume(), m_document.item());
    for (const NamedWindow& window : windows) {
        QString text = tr("%1   (width %2, level %3)")
                           .arg(QString::fromStdString(window.name))
                           .arg(window.window.width, 0, 'g', 5)
                           .arg(window.window.level, 0, 'g', 5);
        // Shown, not bound: the keys are handled in keyPressEvent.
        for (int key = 0; key <= 9; ++key)
            if (const auto bound = windowForKey(m_document.volume(), m_document.item(), key); bound == window)
                text += QLatin1Char('\t') + QString::number(key);
        connect(m_windowMenu->addAction(text), &QAction::triggered, this, [this, window] {
            m_document.changeItem("Window: " + window.name, {},
                                  [&](VolumeItem& item) { item.window = window.window; });
        });
    }
}

void MainWindow::buildHelpMenu() {
    QMenu* menu = menuBar()->addMenu(tr("&Help"));
    connect(addTo(menu, "showKeys", tr("&Mouse and keys"), QKeySequence::HelpContents), &QAction::triggered,
            this, &MainWindow::showKeys);
    QAction* plan = addTo(menu, "showPlan", tr("&Plan of the 3D picture..."));
    connect(plan, &QAction::triggered, this, &MainWindow::showPlan);
    m_needDocument.push_back(plan);
    connect(addTo(menu, "verify", tr("&Verify accuracy...")), &QAction::triggered, this,
            &MainWindow::showVerify);
    connect(addTo(menu, "about", tr("&About Pellucid")), &QAction::triggered, this, &MainWindow::showAbout);
}

void MainWindow::updateActions() {
    for (QAction* action : m_needDocument) action->setEnabled(!m_document.isEmpty());
    const UndoStack& stack = m_document.undoStack();
    m_undoAction->setEnabled(stack.canUndo());
    m_redoAction->setEnabled(stack.canRedo());
    m_undoAction->setText(stack.canUndo() ? tr("Undo: %1").arg(QString::fromStdString(stack.undoName()))
                                          : tr("Undo"));
    m_redoAction->setText(stack.canRedo() ? tr("Redo: %1").arg(QString::fromStdString(stack.redoName()))
                                          : tr("Redo"));
    m_undoAction->setIconText(tr("Undo"));
    m_redoAction->setIconText(tr("Redo"));
}

void MainWindow::openFiles() {
    const QStringList files = QFileDialog::getOpenFileNames(this, tr("Open a scan or a scene"));
    std::vector<std::filesystem::path> paths;
    for (const QString& file : files) paths.emplace_back(file.toStdString());
    if (mayLeave()) openPaths(paths);
}

void MainWindow::openFolder() {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Open a folder with a DICOM series"));
    if (!folder.isEmpty() && mayLeave()) openPaths({folder.toStdString()});
}

void MainWindow::rememberRecent(const std::vector<std::filesystem::path>& paths) {
    // A list of files has no single name to open it again by.
    if (paths.size() != 1) return;
    QSettings settings;
    QStringList recent = settings.value(kRecentKey).toStringList();
    const QString path = QString::fromStdString(std::filesystem::absolute(paths.front()).string());
    recent.removeAll(path);
    recent.prepend(path);
    settings.setValue(kRecentKey, recent.mid(0, kMaxRecent));
}

void MainWindow::fillRecentMenu() {
    m_recentMenu->clear();
    for (const QString& path : QSettings().value(kRecentKey).toStringList())
        connect(m_recentMenu->addAction(path), &QAction::triggered, this, [this, path] {
            if (mayLeave()) openPaths({path.toStdString()});
        });
    if (m_recentMenu->isEmpty()) m_recentMenu->addAction(tr("Nothing yet"))->setEnabled(false);
}

bool MainWindow::saveScene() {
    return m_document.sceneFile().empty() ? saveSceneAs() : saveSceneTo(m_document.sceneFile());
}

bool MainWindow::saveSceneAs() {
    QString file = QFileDialog::getSaveFileName(this, tr("Save scene"), QStringLiteral("scene.json"),
                                                tr("Scenes (*.json)"));
    return !file.isEmpty() && saveSceneTo(file.toStdString());
}

bool MainWindow::saveSceneTo(const std::filesystem::path& file) {
    const auto saved = io::saveScene(file, m_document.scene());
    if (!saved) {
        m_messages->say(MessageBar::Kind::Error, QString::fromStdString(saved.error().text()));
        return false;
    }
    m_document.setSaved(file);
    rememberRecent({file});
    return true;
}

bool MainWindow::mayLeave() {
    if (!isWindowModified()) return true;
    const auto answer =
        QMessageBox::question(this, tr("Pellucid"), tr("Save the changes of %1?").arg(m_document.title()),
                              QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
    return answer == QMessageBox::Discard || (answer == QMessageBox::Save && saveScene());
}

void MainWindow::showExport() {
    std::vector<ExportDialog::Choice> choices{{tr("3D"), m_volumeView}};
    for (SliceView* view : m_slices) choices.push_back({tr(name(view->plane())), view});
    auto* dialog = new ExportDialog(m_document, m_service, std::move(choices), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &ExportDialog::exported, this, [this](const QString& file) {
        m_messages->say(MessageBar::Kind::Note, tr("The picture is in %1.").arg(file));
    });
    dialog->open();
}

void MainWindow::showPlan() {
    const auto& reply = m_volumeView->lastReply();
    if (!reply || !reply->frame) return;
    showText(this, "planDialog", tr("Plan of the 3D picture"),
             QString::fromStdString(renderer::planText(reply->frame->plan)), {860, 560});
}

void MainWindow::showVerify() {
    auto* open = findChild<VerifyDialog*>();
    // One that was closed is hidden until its run has ended.
    if (!open || !open->isVisible()) open = new VerifyDialog(this);
    open->show();
    open->raise();
    open->activateWindow();
}

void MainWindow::showInformation() {
    showText(this, "informationDialog", tr("Information on the scan"),
             QString::fromStdString(scanInformation(m_document.volume())), {760, 520});
}

void MainWindow::showKeys() {
    showText(this, "keysDialog", tr("Mouse and keys"), tr(kKeysText), {720, 560});
}

void MainWindow::showAbout() {
    auto* box = new QMessageBox(QMessageBox::NoIcon, tr("About Pellucid"), {}, QMessageBox::Close, this);
    box->setObjectName(QStringLiteral("aboutBox"));
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setText(
        tr("<h3>Pellucid</h3><p>Pictures of volume data, with their cost and their error.</p>"
           "<p><b>Pellucid is not a medical device.</b> It is not made, tested or approved for diagnosis or "
           "treatment.</p>"
           "<p>BSD-3-Clause licence. Data stay on this computer.</p>"));
    box->setInformativeText(m_device.isEmpty() ? QString{} : tr("Drawn by %1").arg(m_device));
    box->open();
}

}  // namespace pellucid::app
