// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The error a frame states of itself, held against the reference on real scans and synthetic fields.
#include "io/load.h"
#include "tests/accuracy/estimate_judge.h"

namespace pellucid::test {
namespace {

class Estimate : public GpuTest {
protected:
    static renderer::Frame estimated(const Scene& scene, const VolumePtr& volume) {
        renderer::RenderOptions options;
        options.estimateError = true;
        options.estimateReduction = 1;
        return frameOf(scene, volume, options);
    }
};

/// Estimated maximum and RMSE are within a factor of 2 of the true ones on at least 95 % of frames.
TEST_F(Estimate, LiesWithinAFactorOfTwo) {
    std::vector<std::pair<std::string, VolumePtr>> sources{{"Marschner-Lobb", accuracy::marschnerLobb(40)}};
    for (const char* path :
         {PELLUCID_SOURCE_DIR "/resources/sample/ct-torso.nii.gz", PELLUCID_TEST_DATA "/ct-head-64"}) {
        auto volume = io::loadVolume({path});
        ASSERT_TRUE(volume) << volume.error().text();
        sources.emplace_back(path, *volume);
    }
    EstimateJudge judge;
    for (const auto& [name, volume] : sources) {
        const auto draw = [&](const Scene& scene) { return estimated(scene, volume); };
        const std::vector<AnatomicalView> views{AnatomicalView::Anterior, AnatomicalView::Left};
        for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Mip})
            judge.judgeViews(sceneIn(mode, false), volume, name, views, draw);
        judge.judgeViews(sceneIn(Mode::Composite, true), volume, name + " lit", views, draw);
    }
    judge.max.expectGood("maximum");
    judge.rmse.expectGood("RMSE");
}

}  // namespace
}  // namespace pellucid::test
