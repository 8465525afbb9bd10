// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <QCheckBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTimer>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/desktop/verify_dialog.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

class VerifyDialogTest : public GuiTest {
protected:
    void SetUp() override {
        GuiTest::SetUp();
        child<QAction>("verify")->trigger();
        ASSERT_TRUE(waitFor([this] { return dialog() && dialog()->isVisible(); }));
    }
    QDialog* dialog() { return window.findChild<QDialog*>(QStringLiteral("verifyDialog")); }
    QTableWidget* table() { return child<QTableWidget>("verifyTable"); }
    QPushButton* run() { return child<QPushButton>("verifyRun"); }
    void chooseOnly(const QString& part) {
        for (const char* name : {"verifyStep", "verifyGrid", "verifyPixel", "verifyExtreme"})
            if (child<QCheckBox>(name)->isChecked() != (QLatin1String(name) == part))
                child<QCheckBox>(name)->click();
    }
    /// Saves through the file dialog, as a user who types the name.
    void saveAs(const std::filesystem::path& file) {
        QTimer::singleShot(0, [file] {
            auto* asked = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
            ASSERT_NE(asked, nullptr);
            asked->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
                ->setText(QString::fromStdString(file.string()));
            QTest::keyClick(asked, Qt::Key_Return);
        });
        child<QPushButton>("verifySave")->click();
    }
    static std::string contents(const std::filesystem::path& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    }
};

/// Three of the extreme cases, of which the last has been given a wrong answer.
Result<accuracy::Verification> threeCases(
    renderer::Renderer& renderer, const accuracy::VerificationParts&, const Progress& progress,
    const std::function<void(const accuracy::VerificationLine&)>& found) {
    auto cases = accuracy::extremeCases();
    cases.resize(3);
    cases.back().truth = accuracy::EveryPixel{glm::dvec4(0.5)};
    accuracy::Verification verification{"Pellucid", "a driver"};
    auto& rows = verification.extremes.emplace();
    for (const accuracy::ExtremeCase& one : cases) {
        if (!goOn(progress, 0.5, one.name)) return fail(ErrorCode::Cancelled, "cancelled");
        rows.push_back(accuracy::verifyExtreme(renderer, one));
        found(lineOf(rows.back()));
    }
    return verification;
}

TEST_F(VerifyDialogTest, FillsTheTableAndSavesTheReport) {
    dialog()->close();
    ASSERT_TRUE(waitFor([this] { return !dialog(); }));
    (new app::VerifyDialog(&window, threeCases))->show();
    EXPECT_FALSE(child<QPushButton>("verifySave")->isEnabled());
    run()->click();
    EXPECT_EQ(run()->text(), QStringLiteral("&Cancel"));
    EXPECT_TRUE(child<QWidget>("verifyProgress")->isVisible());
    ASSERT_TRUE(waitFor([this] { return child<QPushButton>("verifySave")->isEnabled(); }));
    ASSERT_EQ(table()->rowCount(), 3);
    const auto cases = accuracy::extremeCases();
    for (int row = 0; row < 3; ++row) {
        EXPECT_EQ(table()->item(row, 0)->text().toStdString(), cases[static_cast<std::size_t>(row)].name);
        EXPECT_EQ(table()->item(row, 3)->text(), row < 2 ? QStringLiteral("pass") : QStringLiteral("FAIL"));
    }
    EXPECT_TRUE(table()->item(2, 4)->text().contains(QStringLiteral("the bound")));
    const QString summary = child<QLabel>("verifySummary")->text();
    EXPECT_TRUE(summary.startsWith(QStringLiteral("1 of 3 rows FAILED"))) << summary.toStdString();
    EXPECT_FALSE(child<QWidget>("verifyProgress")->isVisible());

    QTemporaryDir folder;
    const std::filesystem::path place = folder.path().toStdString();
    saveAs(place / "report.json");
    const auto json = nlohmann::json::parse(contents(place / "report.json"));
    EXPECT_FALSE(json["passed"].get<bool>());
    EXPECT_EQ(json["extreme"]["rows"].size(), 3u);
    EXPECT_FALSE(json.contains("orders"));
    saveAs(place / "report.txt");
    const std::string text = contents(place / "report.txt");
    EXPECT_EQ(text.find("Pellucid; a driver\n"), 0u) << text;
    EXPECT_NE(text.find("3 cases, 1 failed."), std::string::npos) << text;
}

TEST_F(VerifyDialogTest, CancelKeepsTheRowsFoundAndARunCanFollow) {
    chooseOnly(QStringLiteral("verifyExtreme"));
    run()->click();
    ASSERT_TRUE(waitFor([this] { return table()->rowCount() > 2; }));
    run()->click();
    EXPECT_FALSE(run()->isEnabled()) << "until the run has ended";
    ASSERT_TRUE(waitFor([this] { return run()->isEnabled(); }));
    EXPECT_EQ(run()->text(), QStringLiteral("&Run"));
    const QString summary = child<QLabel>("verifySummary")->text();
    EXPECT_TRUE(summary.startsWith(QStringLiteral("Cancelled after"))) << summary.toStdString();
    EXPECT_FALSE(child<QPushButton>("verifySave")->isEnabled()) << "half a run is no report";
    run()->click();
    EXPECT_EQ(table()->rowCount(), 0);
    ASSERT_TRUE(waitFor([this] { return table()->rowCount() > 0; }));
}

TEST_F(VerifyDialogTest, ClosedWhileItRunsItGoesAndTheViewsGoOn) {
    QPointer<QDialog> open = dialog();
    run()->click();
    ASSERT_TRUE(waitFor([this] { return table()->rowCount() > 0; }));
    QElapsedTimer since;
    since.start();
    open->close();
    EXPECT_LT(since.elapsed(), 500) << "closing waits for nothing";
    EXPECT_FALSE(open->isVisible());
    volumeView()->setStandardView(AnatomicalView::Left);
    EXPECT_TRUE(settle());
    EXPECT_TRUE(waitFor([&] { return open.isNull(); })) << "deleted once the run has ended";
}

TEST_F(VerifyDialogTest, NothingChosenCannotRunAndTabReachesEveryControl) {
    chooseOnly({});
    EXPECT_FALSE(run()->isEnabled());
    child<QCheckBox>("verifyGrid")->click();
    EXPECT_TRUE(run()->isEnabled());
    dialog()->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(dialog()));
    child<QWidget>("verifyStep")->setFocus();
    QStringList order;
    for (int i = 0; i < 6; ++i) {
        order += QApplication::focusWidget()->objectName();
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
    }
    EXPECT_EQ(order.join(u' ').toStdString(),
              "verifyStep verifyGrid verifyPixel verifyExtreme verifyRun verifyTable");
}

}  // namespace
}  // namespace pellucid::test
