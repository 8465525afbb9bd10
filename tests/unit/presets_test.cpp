// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/presets.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/unit/test_volumes.h"

namespace pellucid {
namespace {

using test::makeVolume;

TEST(VolumePresets, AreValidNamedAndFound) {
    std::set<std::string> names;
    for (const VolumePreset& preset : volumePresets()) {
        SCOPED_TRACE(preset.name);
        EXPECT_TRUE(names.insert(preset.name).second);
        EXPECT_TRUE(validate(preset.function));
        EXPECT_EQ(preset.function.name, preset.name);
        EXPECT_TRUE(preset.name.starts_with(preset.modality + " "));
        EXPECT_EQ(preset.function.unit, preset.modality == "CT" ? "HU" : "");
        EXPECT_GT(preset.material.shininess, 0.0);
        ASSERT_NE(findVolumePreset(preset.name), nullptr);
        EXPECT_EQ(findVolumePreset(preset.name)->name, preset.name);
    }
    EXPECT_GE(names.size(), 10u);
    EXPECT_EQ(findVolumePreset("ct bone"), nullptr);
}

TEST(VolumePresets, FollowTheNodesOfTheFileWithinHalfAGreyLevel) {
    std::ifstream file(PELLUCID_SOURCE_DIR "/resources/presets/volume_presets.json");
    const auto json = nlohmann::json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    ASSERT_EQ(json["presets"].size(), volumePresets().size());
    for (std::size_t p = 0; p < volumePresets().size(); ++p) {
        const auto& nodes = json["presets"][p]["transferFunction"]["points"];
        const VolumePreset& preset = volumePresets()[p];
        EXPECT_EQ(json["presets"][p]["name"], preset.name);
        for (std::size_t i = 1; i < nodes.size(); ++i) {
            for (int s = 0; s < 200; ++s) {
                const double t = s / 200.0;
                const double value =
                    std::lerp(nodes[i - 1]["value"].get<double>(), nodes[i]["value"].get<double>(), t);
                const double wanted =
                    std::lerp(nodes[i - 1]["opacity"].get<double>(), nodes[i]["opacity"].get<double>(), t);
                const OpticalSample sample = evaluate(preset.function, value);
                EXPECT_NEAR(opacityFromExtinction(sample.extinction), wanted, 0.5 / 255.0)
                    << preset.name << " " << value;
            }
        }
    }
}

TEST(VolumePresets, HoldTheKnownNumbers) {
    const VolumePreset* bone = findVolumePreset("CT bone");
    ASSERT_NE(bone, nullptr);
    const OpticalSample at641 = evaluate(bone->function, 641.385);
    EXPECT_NEAR(opacityFromExtinction(at641.extinction), 0.715686, 1e-12);
    EXPECT_NEAR(at641.color.y, 0.815686, 1e-12);
    EXPECT_EQ(evaluate(bone->function, -16.4458).extinction, 0.0);
    EXPECT_EQ(bone->material, (Material{0.1, 0.9, 0.2, 10.0}));
}

TEST(WindowPresets, AreThoseOfTheReadingRoom) {
    std::set<int> keys;
    std::set<std::string> names;
    std::map<std::string, Window> windows;
    for (const WindowPreset& preset : ctWindowPresets()) {
        EXPECT_GT(preset.window.width, 0.0);
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
        EXPECT_TRUE(preset.key >= 0 && preset.key <= 9);
        EXPECT_TRUE(preset.key == 0 || keys.insert(preset.key).second) << preset.name;
        windows[preset.name] = preset.window;
    }
    EXPECT_EQ(windows["Brain"], (Window{40, 80}));
    EXPECT_EQ(windows["Lung"], (Window{-600, 1500}));
    EXPECT_EQ(windows["Bone"], (Window{350, 2000}));
    EXPECT_EQ(keys.size(), 9u);  // 0 is the full range.
}

/// Most voxels near 10 (air), a broad class around 200 (tissue).
VolumePtr mrLike() {
    std::vector<std::uint16_t> values;
    for (int i = 0; i < 8000; ++i)
        values.push_back(static_cast<std::uint16_t>(i < 6000 ? 5 + i % 11 : 120 + i % 161));
    return makeVolume<std::uint16_t>({20, 20, 20}, values);
}

TEST(Defaults, BackgroundIsTransparentAndTissueIsNot) {
    const TransferFunction1D function = defaultTransferFunction(*mrLike(), 0);
    ASSERT_TRUE(validate(function));
    EXPECT_EQ(evaluate(function, 10).extinction, 0.0);
    EXPECT_EQ(evaluate(function, 15).extinction, 0.0);
    EXPECT_GT(opacityFromExtinction(evaluate(function, 200).extinction), 0.1);
    EXPECT_GT(evaluate(function, 250).extinction, evaluate(function, 150).extinction);
    const double isovalue = defaultIsovalue(*mrLike(), 0);
    EXPECT_GT(isovalue, 15.0);
    EXPECT_LT(isovalue, 120.0);
    const Window window = defaultWindow(*mrLike(), 0);
    EXPECT_NEAR(window.level - window.width / 2, 5.0, 1.0);
    EXPECT_NEAR(window.level + window.width / 2, 280.0, 2.0);
}

TEST(Defaults, AnOutlierSpoilsNothing) {
    std::vector<float> values;
    for (int i = 0; i < 8000; ++i)
        values.push_back(i < 6000 ? 5.0f + static_cast<float>(i % 11) : 120.0f + static_cast<float>(i % 161));
    values[17] = 1e30f;
    values[18] = std::numeric_limits<float>::quiet_NaN();
    const VolumePtr volume = makeVolume<float>({20, 20, 20}, values);
    const TransferFunction1D function = defaultTransferFunction(*volume, 0);
    EXPECT_EQ(evaluate(function, 15).extinction, 0.0);
    EXPECT_GT(opacityFromExtinction(evaluate(function, 200).extinction), 0.1);
    EXPECT_LT(defaultWindow(*volume, 0).width, 400.0);
}

TEST(Defaults, CtIsShownAsCt) {
    const VolumePtr byUnit = makeVolume<std::int16_t>({2, 1, 1}, {-1000, 1000}, {1, 0, "HU"});
    VolumeInfo info;
    info.modality = "CT";
    info.windows = {{"BRAIN", {35, 90}}};
    const VolumePtr byModality = makeVolume<std::int16_t>({2, 1, 1}, {-1000, 1000}, {}, 1, info);
    for (const VolumePtr& volume : {byUnit, byModality}) {
        const TransferFunction1D function = defaultTransferFunction(*volume, 0);
        EXPECT_EQ(function.unit, "HU");
        EXPECT_EQ(evaluate(function, -1000).extinction, 0.0);
        EXPECT_LT(opacityFromExtinction(evaluate(function, 40).extinction), 0.05);  // Soft tissue: a veil,
        EXPECT_GT(opacityFromExtinction(evaluate(function, 220).extinction),
                  0.25);  // contrast in vessels: seen,
        EXPECT_GT(opacityFromExtinction(evaluate(function, 900).extinction), 0.7);  // bone: dense.
        EXPECT_EQ(defaultIsovalue(*volume, 0), 300.0);
    }
    EXPECT_EQ(defaultWindow(*byUnit, 0), (Window{40, 400}));
    EXPECT_EQ(defaultWindow(*byModality, 0), (Window{35, 90}));
}

TEST(Defaults, HounsfieldValuesAreKnownWithoutAName) {
    std::vector<std::int16_t> values(1000, -1000);
    for (std::size_t i = 300; i < values.size(); ++i) values[i] = static_cast<std::int16_t>(i);
    const auto isCt = [](const VolumePtr& volume) {
        return defaultTransferFunction(*volume, 0).unit == "HU";
    };
    EXPECT_TRUE(isCt(makeVolume<std::int16_t>({10, 10, 10}, values)));
    VolumeInfo mr;
    mr.modality = "MR";
    EXPECT_FALSE(isCt(makeVolume<std::int16_t>({10, 10, 10}, values, {}, 1, mr)));
    EXPECT_FALSE(isCt(makeVolume<std::int16_t>({10, 10, 10}, values, {1, 0, "ms"})));
    EXPECT_FALSE(isCt(makeVolume<std::int16_t>({10, 10, 10}, values, {1, 400, ""})));  // No air at -1000.
    EXPECT_FALSE(
        isCt(makeVolume<std::int16_t>({10, 10, 10}, values, {0.1, -900, ""})));  // Nothing above 200.
    std::vector<std::int16_t> lone(1000, 500);
    lone[0] = -1000;
    EXPECT_FALSE(isCt(makeVolume<std::int16_t>({10, 10, 10}, lone)));
}

TEST(Defaults, WorkForEveryKindOfData) {
    const double most = std::numeric_limits<double>::max(), nan = std::nan("");
    const float nanF = std::numeric_limits<float>::quiet_NaN();
    const struct {
        const char* name;
        VolumePtr volume;
    } cases[] = {{"one voxel", makeVolume<std::uint8_t>({1, 1, 1}, {7})},
                 {"constant", makeVolume<float>({3, 1, 1}, {2.5f, 2.5f, 2.5f})},
                 {"constant and huge", makeVolume<double>({2, 1, 1}, {1e300, 1e300})},
                 {"all zero", makeVolume<std::int16_t>({4, 1, 1}, {0, 0, 0, 0})},
                 {"only NaN", makeVolume<float>({2, 1, 1}, {nanF, nanF})},
                 {"some NaN", makeVolume<double>({4, 1, 1}, {nan, 1.0, 2.0, nan})},
                 {"two values", makeVolume<std::uint8_t>({4, 1, 1}, {0, 0, 0, 255})},
                 {"tiny range", makeVolume<double>({3, 1, 1}, {1.0, std::nextafter(1.0, 2.0), 1.0})},
                 {"denormals", makeVolume<double>({3, 1, 1}, {0.0, 5e-324, 1e-323})},
                 {"the whole range", makeVolume<double>({4, 1, 1}, {-most, most, 0.0, 1.0})},
                 {"negative slope", makeVolume<std::uint8_t>({4, 1, 1}, {0, 1, 2, 3}, {-1e6, 5, ""})},
                 {"constant CT", makeVolume<std::int16_t>({2, 1, 1}, {40, 40}, {1, 0, "HU"})},
                 {"empty CT", makeVolume<std::int16_t>({2, 1, 1}, {-1024, -1024}, {1, 0, "HU"})}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        EXPECT_TRUE(validate(defaultTransferFunction(*test.volume, 0)));
        const Window window = defaultWindow(*test.volume, 0);
        EXPECT_TRUE(std::isfinite(window.level));
        EXPECT_TRUE(std::isfinite(window.width) && window.width > 0.0);
        EXPECT_NE(window.level - window.width / 2, window.level + window.width / 2);
        EXPECT_TRUE(std::isfinite(defaultIsovalue(*test.volume, 0)));
    }
}

TEST(Defaults, EachComponentHasItsOwn) {
    std::vector<std::uint8_t> values;
    for (int i = 0; i < 1000; ++i) {
        values.push_back(static_cast<std::uint8_t>(i % 10));
        values.push_back(static_cast<std::uint8_t>(200 + i % 10));
    }
    const VolumePtr volume = makeVolume<std::uint8_t>({10, 10, 10}, values, {}, 2);
    EXPECT_LT(defaultWindow(*volume, 0).level, 10.0);
    EXPECT_GT(defaultWindow(*volume, 1).level, 200.0);
}

}  // namespace
}  // namespace pellucid
