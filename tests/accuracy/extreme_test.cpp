// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/extreme.h"

#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

class Extreme : public GpuTest {};

TEST_F(Extreme, EveryCaseIsWithinItsBound) {
    const auto rows = accuracy::verifyExtremes(gpu());
    ASSERT_TRUE(rows);
    EXPECT_GE(rows->size(), 200u);
    EXPECT_TRUE(accuracy::allPassed(*rows)) << accuracy::extremeText(*rows);
}

/// The judge itself: a wrong closed form, an unexpected picture and an unexpected refusal all fail.
TEST_F(Extreme, WrongAnswersFail) {
    auto cases = accuracy::extremeCases();
    accuracy::ExtremeCase drawn = cases.front();
    EXPECT_TRUE(accuracy::verifyExtreme(gpu(), drawn).passed);
    drawn.truth = accuracy::EveryPixel{glm::dvec4(0.5)};
    EXPECT_FALSE(accuracy::verifyExtreme(gpu(), drawn).passed);
    drawn.truth = accuracy::Refused{"samples"};
    EXPECT_FALSE(accuracy::verifyExtreme(gpu(), drawn).passed);
    for (accuracy::ExtremeCase& refused : cases)
        if (std::holds_alternative<accuracy::Refused>(refused.truth)) {
            refused.truth = accuracy::AsReference{};
            EXPECT_FALSE(accuracy::verifyExtreme(gpu(), refused).passed) << refused.name;
        }
}

accuracy::ExtremeCase caseNamed(const std::string& name) {
    for (accuracy::ExtremeCase& extreme : accuracy::extremeCases())
        if (extreme.name == name) return std::move(extreme);
    ADD_FAILURE() << "no case " << name;
    return {};
}

/// A bound that nothing exceeds, a reference that has not settled, an error that is not told.
TEST_F(Extreme, RowsThatCannotFailFail) {
    accuracy::ExtremeCase faint = caseNamed("tau * step = 1e-08, composite, exponential");
    EXPECT_TRUE(accuracy::verifyExtreme(gpu(), faint).passed);
    faint.bound = 2.5e-7;  // the brightest channel is 4.8e-7
    EXPECT_FALSE(accuracy::verifyExtreme(gpu(), faint).passed);
    faint.isEmpty = true;
    EXPECT_FALSE(accuracy::verifyExtreme(gpu(), faint).passed) << "it is not empty";
    accuracy::ExtremeCase empty = caseNamed("opacity exactly 0");
    EXPECT_TRUE(accuracy::verifyExtreme(gpu(), empty).passed);
    empty.isEmpty = false;
    EXPECT_FALSE(accuracy::verifyExtreme(gpu(), empty).passed);

    // The light of normals is smooth, not polynomial: the reference has some error.
    accuracy::ExtremeCase lit = caseNamed("1 lights of intensity 1");
    lit.bound = 1e-9;
    const accuracy::ExtremeRow unsettled = accuracy::verifyExtreme(gpu(), lit);
    EXPECT_FALSE(unsettled.passed);
    EXPECT_NE(unsettled.outcome.find("the reference still changes"), std::string::npos) << unsettled.outcome;
}

/// Samples a voxel apart miss a peak: right only as long as the frame says so.
TEST_F(Extreme, AnErrorPassesOnlyWhenTheFrameTellsIt) {
    accuracy::ExtremeCase missed = caseNamed("peak of width 2e-06 of the values, exponential");
    EXPECT_TRUE(accuracy::verifyExtreme(gpu(), missed).passed);
    const auto build = missed.build;
    // Emission and surfaces have no integrals to be compared with: their estimates stay blind.
    missed.build = [build] {
        accuracy::ExtremeScene scene = build();
        scene.scene.mode = Mode::FirstHit;
        scene.scene.hitOpacity = 0.5;
        return scene;
    };
    missed.truth = accuracy::Admitted{{0.25, 0.5, 0.75, 1.0}};
    const accuracy::ExtremeRow silent = accuracy::verifyExtreme(gpu(), missed);
    EXPECT_FALSE(silent.passed) << silent.outcome;
}

}  // namespace
}  // namespace pellucid::test
