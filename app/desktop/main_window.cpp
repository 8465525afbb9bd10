// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/main_window.h"

#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMimeData>
#include <QScrollArea>
#include <QSettings>
#include <QStatusBar>
#include <QToolButton>
#include <QUrl>

#include "app/desktop/coarse_preview.h"
#include "app/desktop/cost_text.h"
#include "app/desktop/light_panel.h"
#include "app/desktop/load_bar.h"
#include "app/desktop/look_panel.h"
#include "app/desktop/message_bar.h"
#include "app/desktop/quality_panel.h"
#include "app/desktop/series_dialog.h"
#include "app/desktop/slice_view.h"
#include "app/desktop/view_frame.h"
#include "app/desktop/volume_view.h"
#include "app/desktop/window_panel.h"

namespace pellucid::app {

namespace {

constexpr int kPanelWidth = 340;
constexpr const char* kFrameTargetKey = "frameTargetMs";

/// What the user has set, else what suits the device.
double frameTargetMs(bool isSoftwareDevice) {
    const double set = QSettings().value(kFrameTargetKey).toDouble();
    return set > 0.0 ? set : renderer::defaultFrameTargetMs(isSoftwareDevice);
}

QString nameOf(const std::vector<std::filesystem::path>& paths) {
    if (paths.size() != 1) return MainWindow::tr("%n files", nullptr, static_cast<int>(paths.size()));
    // A folder given with a trailing slash has no file name of its own.
    const auto& path = paths.front();
    return QString::fromStdString(
        (path.has_filename() ? path.filename() : path.parent_path().filename()).string());
}

}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent) {
    setObjectName(QStringLiteral("mainWindow"));
    setAcceptDrops(true);
    resize(1600, 1000);
    buildViews();
    buildPanels();
    buildStatusBar();
    buildActions();
    connectLoader();
    connect(&m_document, &Document::undoChanged, this, &MainWindow::updateTitle);
    connect(&m_document, &Document::refused, this,
            [this](const QString& sentence) { m_messages->say(MessageBar::Kind::Error, sentence); });
    connect(&m_service, &RenderService::started, this,
            [this](const QString& device, const QString& error, bool isSoftwareDevice) {
                m_device = device;
                setFrameTargetMs(frameTargetMs(isSoftwareDevice));
                if (!error.isEmpty()) m_messages->say(MessageBar::Kind::Error, error);
            });
    connect(m_qualityPanel, &QualityPanel::frameTargetEdited, this, [this](double ms) {
        QSettings().setValue(kFrameTargetKey, ms);
        m_volumeView->setFrameTargetMs(ms);
    });
    updateTitle();
}

MainWindow::~MainWindow() = default;

void MainWindow::setFrameTargetMs(double ms) {
    m_volumeView->setFrameTargetMs(ms);
    m_qualityPanel->setFrameTargetMs(ms);
}

void MainWindow::buildViews() {
    auto* central = new QWidget(this);
    auto* column = new QVBoxLayout(central);
    column->setContentsMargins(4, 4, 4, 4);
    column->setSpacing(4);
    m_messages = new MessageBar(central);
    m_loadBar = new LoadBar(central);
    m_welcome = new QLabel(tr("Open a scan with File > Open, or drop a file or a folder here."), central);
    m_welcome->setObjectName(QStringLiteral("welcome"));
    m_welcome->setAlignment(Qt::AlignCenter);
    m_welcome->setForegroundRole(QPalette::PlaceholderText);
    m_views = new QWidget(central);
    column->addWidget(m_messages);
    column->addWidget(m_loadBar);
    column->addWidget(m_welcome, 1);
    column->addWidget(m_views, 1);
    m_views->hide();
    setCentralWidget(central);
    m_preview = new CoarsePreview(m_service, central);

    for (const Plane plane : {Plane::Axial, Plane::Coronal, Plane::Sagittal})
        m_slices.push_back(new SliceView(plane, m_document, m_service, m_views));
    m_volumeView = new VolumeView(m_document, m_service, m_views);
    m_frames = {
        new ViewFrame(m_slices[0], m_document, m_views), new ViewFrame(m_volumeView, m_document, m_views),
        new ViewFrame(m_slices[1], m_document, m_views), new ViewFrame(m_slices[2], m_document, m_views)};
    auto* grid = new QGridLayout(m_views);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(4);
    for (int i = 0; i < 4; ++i) grid->addWidget(m_frames[static_cast<std::size_t>(i)], i / 2, i % 2);

    for (ViewFrame* frame : m_frames) {
        ViewWidget* view = frame->view();
        connect(view, &ViewWidget::maximiseAsked, this, [this, frame] { toggleMaximised(frame); });
        connect(view, &ViewWidget::probed, this, [this](const QString& text) { m_probe->setText(text); });
        connect(view, &ViewWidget::pictureShown, this,
                [this, view](const RenderService::Reply& reply) { showCost(view, reply); });
    }
}

void MainWindow::buildPanels() {
    auto* content = new QWidget(this);
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(10, 4, 10, 4);
    column->addWidget(new LookPanel(m_document, content));
    column->addWidget(new WindowPanel(m_document, content));
    column->addWidget(new LightPanel(m_document, content));
    m_qualityPanel = new QualityPanel(m_document, content);
    column->addWidget(m_qualityPanel);
    column->addStretch(1);
    content->hide();  // Controls of nothing would only puzzle.
    connect(&m_document, &Document::replaced, content, &QWidget::show);

    auto* scroll = new QScrollArea(this);
    scroll->setWidget(content);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* dock = new QDockWidget(tr("Settings"), this);
    dock->setObjectName(QStringLiteral("settingsDock"));
    dock->setFeatures(QDockWidget::DockWidgetClosable);
    dock->setTitleBarWidget(new QWidget(dock));  // None: its groups say what they are.
    dock->setWidget(scroll);
    dock->setMinimumWidth(kPanelWidth);
    addDockWidget(Qt::RightDockWidgetArea, dock);
}

void MainWindow::buildStatusBar() {
    m_probe = new QLabel(this);
    m_probe->setObjectName(QStringLiteral("probe"));
    m_cost = new QLabel(this);
    m_cost->setObjectName(QStringLiteral("cost"));
    m_cost->setMinimumWidth(1);  // A long line must not hold the window wide.
    m_planButton = new QToolButton(this);
    m_planButton->setObjectName(QStringLiteral("planButton"));
    m_planButton->setText(tr("Plan..."));
    m_planButton->setAutoRaise(true);
    m_planButton->setEnabled(false);
    connect(m_planButton, &QToolButton::clicked, this, &MainWindow::showPlan);
    statusBar()->addWidget(m_probe, 1);
    statusBar()->addPermanentWidget(m_cost);
    statusBar()->addPermanentWidget(m_planButton);
}

void MainWindow::connectLoader() {
    connect(m_loadBar, &LoadBar::cancelAsked, &m_loader, &Loader::cancel);
    connect(&m_loader, &Loader::progressed, m_loadBar, &LoadBar::report);
    connect(&m_loader, &Loader::previewed, this, [this](const VolumePtr& coarse) {
        m_preview->begin(coarse, (m_views->isVisible() ? m_views : m_welcome)->geometry());
    });
    connect(m_volumeView, &ViewWidget::pictureShown, m_preview, [this] {
        if (!m_loader.isLoading()) m_preview->end();
    });
    connect(&m_loader, &Loader::loaded, this, &MainWindow::showScan);
    connect(&m_loader, &Loader::seriesFound, this, &MainWindow::askForSeries);
    connect(&m_loader, &Loader::seriesFound, m_preview, &CoarsePreview::end);
    connect(&m_loader, &Loader::failed, m_preview, &CoarsePreview::end);
    connect(&m_loader, &Loader::failed, this,
            [this](const Error& error, const std::vector<std::filesystem::path>& paths) {
                m_loadBar->hide();
                if (error.code == ErrorCode::Cancelled)
                    m_messages->say(MessageBar::Kind::Note,
                                    tr("Opening %1 was cancelled.").arg(nameOf(paths)));
                else
                    m_messages->say(MessageBar::Kind::Error,
                                    tr("%1 could not be opened. %2")
                                        .arg(nameOf(paths), QString::fromStdString(error.text())));
            });
}

void MainWindow::openPaths(const std::vector<std::filesystem::path>& paths, const io::LoadOptions& options) {
    if (paths.empty()) return;
    m_messages->hide();
    m_loadBar->begin(nameOf(paths));
    m_loader.start(paths, options);
}

void MainWindow::showScan(OpenedScan scan) {
    m_loadBar->hide();
    rememberRecent(scan.paths);
    m_welcome->hide();
    m_views->show();
    centralWidget()->layout()->activate();
    m_preview->setGeometry(m_views->geometry());
    m_document.replace(std::move(scan));
    QStringList sentences;
    for (const Warning& warning : m_document.volume().info().warnings)
        sentences += QString::fromStdString(warning.message);
    if (!sentences.isEmpty()) m_messages->say(MessageBar::Kind::Warning, sentences.join(QLatin1Char('\n')));
}

void MainWindow::askForSeries(const std::vector<io::DicomSeries>& series,
                              const std::vector<std::filesystem::path>& paths) {
    m_loadBar->hide();
    auto* dialog = new SeriesDialog(series, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &SeriesDialog::chosen, this, [this, paths](const std::string& uid) {
        io::LoadOptions options;
        options.seriesUid = uid;
        openPaths(paths, options);
    });
    dialog->open();
}

void MainWindow::toggleMaximised(ViewFrame* frame) {
    m_maximised = m_maximised ? nullptr : frame;
    for (ViewFrame* other : m_frames) other->setVisible(!m_maximised || other == m_maximised);
}

void MainWindow::showCost(const ViewWidget* view, const RenderService::Reply& reply) {
    // The 3D view's numbers; a slice's only while it alone is shown.
    if (!reply.frame || (view != m_volumeView && m_volumeView->isVisible())) return;
    if (reply.frame->chosen) m_qualityPanel->setChosen(*reply.frame->chosen);
    const std::optional<double> passingError =
        reply.passing ? m_volumeView->interaction().error(*reply.passing) : std::nullopt;
    m_cost->setText(costText(reply, smallestSpacingMm(m_document.volume().grid()), passingError));
    m_cost->setToolTip(
        tr("Size and time of the last picture; its estimated error (root mean square over all pixels, "
           "and the largest; 255 grey levels are the whole range); the distance of samples on a ray and "
           "how they are summed; graphics memory of the plan. While something moves: what is left out to "
           "keep the frame time, and how far that was off when the view last stood still. Drawn by %1.")
            .arg(m_device));
    m_planButton->setEnabled(true);
}

void MainWindow::updateTitle() {
    const QString title = m_document.title();
    setWindowModified(m_document.isModified() && !m_document.sceneFile().empty());
    setWindowTitle(title.isEmpty() ? tr("Pellucid") : tr("%1[*] - Pellucid").arg(title));
}

void MainWindow::applyWindowKey(int key) {
    if (m_document.isEmpty()) return;
    const auto window = windowForKey(m_document.volume(), m_document.item(), key);
    if (!window) {
        statusBar()->showMessage(
            tr("The CT windows on the keys 1 to 9 need Hounsfield values; 0 shows the full range."), 4000);
        return;
    }
    m_document.changeItem("Window: " + window->name, {},
                          [&](VolumeItem& item) { item.window = window->window; });
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
    // Here and not as shortcuts, because a shortcut does not tell the keypad's digits from the others. Fields
    // that take digits have taken them before they come here.
    const bool isKeypad = event->modifiers() & Qt::KeypadModifier;
    const bool isShifted = event->modifiers() & Qt::ShiftModifier;
    const int key = event->key();
    const auto standard = [&](AnatomicalView plain, AnatomicalView shifted) {
        m_volumeView->setStandardView(isShifted ? shifted : plain);
    };
    // With Shift or without Num Lock the keypad sends the cursor keys that are printed on it.
    if (isKeypad && (key == Qt::Key_1 || key == Qt::Key_End))
        standard(AnatomicalView::Anterior, AnatomicalView::Posterior);
    else if (isKeypad && (key == Qt::Key_3 || key == Qt::Key_PageDown))
        standard(AnatomicalView::Left, AnatomicalView::Right);
    else if (isKeypad && (key == Qt::Key_7 || key == Qt::Key_Home))
        standard(AnatomicalView::Superior, AnatomicalView::Inferior);
    else if (!isKeypad && key >= Qt::Key_0 && key <= Qt::Key_9 && !(event->modifiers() & ~Qt::ShiftModifier))
        applyWindowKey(key - Qt::Key_0);
    else
        QMainWindow::keyPressEvent(event);
}

void MainWindow::closeEvent(QCloseEvent* event) {
    event->setAccepted(mayLeave());
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    std::vector<std::filesystem::path> paths;
    for (const QUrl& url : event->mimeData()->urls())
        if (url.isLocalFile()) paths.emplace_back(url.toLocalFile().toStdString());
    if (paths.empty()) {
        m_messages->say(MessageBar::Kind::Error,
                        tr("Only files and folders of this computer can be opened."));
        return;
    }
    event->acceptProposedAction();
    openPaths(paths);
}

}  // namespace pellucid::app
