// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "scene/names.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {

/// Frames whose stated error is held against the reference.
class EstimateJudge {
public:
    struct Tally {
        int frames = 0, outside = 0, optimistic = 0;
        std::string worst;

        /// Within a factor of 2, or both below a twentieth of a grey level, where float rounding and the
        /// reference's own bound begin.
        void judge(double estimated, double truth, const std::string& what) {
            constexpr double kNothing = 0.05 / 255.0;
            ++frames;
            if (estimated <= 2.0 * truth + kNothing && estimated >= 0.5 * truth - kNothing) return;
            ++outside;
            if (estimated < 0.5 * truth - kNothing) ++optimistic;
            worst +=
                fmt::format("\n{}: estimated {:.3g}, true {:.3g}", what, 255.0 * estimated, 255.0 * truth);
        }
        /// At least 95 % within the factor, none better than it is by more than that.
        void expectGood(const char* figure) const {
            EXPECT_LE(outside, frames / 20) << figure << " of " << frames << " frames, grey levels:" << worst;
            EXPECT_EQ(optimistic, 0) << figure << " of " << frames << " frames, grey levels:" << worst;
        }
    };
    Tally max, rmse;

    using Draw = std::function<renderer::Frame(const Scene&)>;

    /// Judges the scene as it is with steps of 1/2, 1 and 2 voxels from each of the views.
    void judgeViews(Scene scene, const VolumePtr& volume, const std::string& name,
                    const std::vector<AnatomicalView>& views, const Draw& draw) {
        scene = completed(scene, {volume});
        scene.picture.size = {40, 40};
        for (const AnatomicalView view : views) {
            scene.camera.view = view;
            const auto reference = accuracy::referencePicture(scene, {volume}, {1e-4, 5, {}});
            ASSERT_TRUE(reference) << reference.error().text();
            for (const double step : {0.5, 1.0, 2.0}) {
                scene.quality.stepVoxels = step;
                const renderer::Frame frame = draw(scene);
                ASSERT_TRUE(frame.error);
                const auto truth = accuracy::difference(frame.image, reference->image).value();
                const std::string what = fmt::format("{} {} {} step {}", name, pellucid::name(scene.mode),
                                                     pellucid::name(view), step);
                max.judge(frame.error->maxError, truth.maxError, what + " max");
                rmse.judge(frame.error->rmse, truth.rmse, what + " rmse");
            }
        }
    }
};

/// The mode of a scene, unlit or with a headlight; all else from the data.
inline Scene sceneIn(Mode mode, bool lit) {
    Scene scene;
    scene.mode = mode;
    scene.lights.emplace();
    if (lit) scene.lights->push_back(Light{});
    return scene;
}

}  // namespace pellucid::test
