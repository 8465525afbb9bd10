// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "app/cli/console.h"
#include "scene/presets.h"
#include "scene/scene_json.h"

namespace pellucid::app {

namespace {

/// "64x64x93" to its numbers; nothing unless there are exactly n and nothing else. Independent of the locale.
template <class T>
std::optional<std::vector<T>> numbersBetweenX(std::string_view text, std::size_t n) {
    std::vector<T> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (numbers.size() < n) {
        if (!numbers.empty() && (at == end || *at++ != 'x')) return std::nullopt;
        T number{};
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc{}) return std::nullopt;
        numbers.push_back(number);
        at = next;
    }
    return at == end ? std::optional(numbers) : std::nullopt;
}

Result<Scene> withPreset(Scene scene, const std::string& name) {
    const VolumePreset* preset = findVolumePreset(name);
    if (preset == nullptr) {
        std::vector<std::string> names;
        for (const VolumePreset& known : volumePresets()) names.push_back(known.name);
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("--preset: there is no preset '{}', only {}", name, fmt::join(names, ", ")));
    }
    if (scene.volumes.empty()) scene.volumes.emplace_back();
    for (VolumeItem& item : scene.volumes) item.transferFunction = preset->function;
    scene.material = preset->material;
    return scene;
}

Result<Scene> withLook(Scene scene, const LookArguments& look) {
    Result<Scene> changed = std::move(scene);
    const auto set = [&](std::string_view path, std::string_view value) {
        Result<Scene> next = withSetting(*changed, path, value);
        changed = std::move(next);
    };
    if (!look.preset.empty()) changed = withPreset(*changed, look.preset);
    if (changed && !look.view.empty()) {
        changed->camera.pose.reset();  // a pose would hide the view
        set("camera.view", look.view);
    }
    if (changed && !look.mode.empty()) set("mode", look.mode);
    if (changed && !look.size.empty()) {
        const Result<glm::ivec2> size = parseSize(look.size, "--size");
        if (!size) return tl::unexpected(size.error());
        set("picture.size", fmt::format("[{}, {}]", size->x, size->y));
    }
    for (const std::string& setting : look.settings) {
        if (!changed) break;
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos || equals == 0) {
            return fail(
                ErrorCode::InvalidArgument,
                fmt::format("--set takes key=value, for example --set mode=mip; found '{}'", setting));
        }
        set(std::string_view(setting).substr(0, equals), std::string_view(setting).substr(equals + 1));
    }
    return changed;
}

}  // namespace

void addInputOptions(CLI::App& command, InputArguments& a) {
    command
        .add_option("input", a.paths,
                    "A scene (.json), or a scan: a DICOM folder, DICOM files, a DICOMDIR, or one NRRD, "
                    "MetaImage, NIfTI, "
                    "VTI, VTK or raw file")
        ->type_name("SCENE|PATH")
        ->required();
    command.add_option("--series", a.seriesUid, "Which DICOM series, where there are several")
        ->type_name("UID");
    const std::string raw = "Raw voxels";
    command.add_option("--raw-size", a.rawSize, "Read the file as raw voxels of this size, i fastest")
        ->type_name("IxJxK")
        ->group(raw);
    command.add_option("--raw-type", a.rawType, "int8 ... int64, uint8 ... uint64, float32, float64 (uint8)")
        ->type_name("TYPE")
        ->group(raw);
    command.add_option("--raw-components", a.rawComponents, "Values per voxel, 1 to 4 (1)")
        ->type_name("N")
        ->group(raw);
    command.add_option("--raw-endian", a.rawEndian, "little or big (little)")->type_name("ORDER")->group(raw);
    command.add_option("--raw-spacing", a.rawSpacing, "Distances of voxel centres in mm (1x1x1)")
        ->type_name("XxYxZ")
        ->group(raw);
    command.add_option("--raw-header", a.rawHeader, "Bytes before the first voxel (0)")
        ->type_name("BYTES")
        ->group(raw);
    command.add_option("--raw-slope", a.rawSlope, "Physical value = stored * slope + intercept (1)")
        ->group(raw);
    command.add_option("--raw-intercept", a.rawIntercept, "See --raw-slope (0)")->group(raw);
    command.add_option("--raw-unit", a.rawUnit, "Unit of the physical value, such as HU")
        ->type_name("UNIT")
        ->group(raw);
}

void addLookOptions(CLI::App& command, LookArguments& a) {
    command.add_option("--size", a.size, "Size of the picture in pixels")->type_name("WxH");
    command.add_option("--view", a.view, "anterior, posterior, left, right, superior or inferior")
        ->type_name("VIEW");
    command
        .add_option("--mode", a.mode,
                    "composite, mip, minip, average, xray, emission, first-hit, isosurface or slice")
        ->type_name("MODE");
    command.add_option("--preset", a.preset, "A named transfer function, such as \"CT bone\"")
        ->type_name("NAME");
    command
        .add_option("--set", a.settings,
                    "Sets any member of the scene by its path, such as camera.fovDeg=20; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

Result<glm::ivec2> parseSize(std::string_view text, std::string_view option) {
    const auto numbers = numbersBetweenX<int>(text, 2);
    if (!numbers || (*numbers)[0] < 1 || (*numbers)[1] < 1) {
        return fail(
            ErrorCode::InvalidArgument,
            fmt::format("{} takes width and height in pixels, such as 1024x768; found '{}'", option, text));
    }
    return glm::ivec2((*numbers)[0], (*numbers)[1]);
}

Result<std::optional<io::RawLayout>> rawLayout(const InputArguments& a) {
    const bool others = !a.rawType.empty() || a.rawComponents || !a.rawEndian.empty() ||
                        !a.rawSpacing.empty() || a.rawHeader || a.rawSlope || a.rawIntercept ||
                        !a.rawUnit.empty();
    if (a.rawSize.empty()) {
        if (!others) return std::nullopt;
        return fail(ErrorCode::InvalidArgument,
                    "raw voxels need --raw-size too, such as --raw-size 64x64x93");
    }
    io::RawLayout layout;
    const auto size = numbersBetweenX<int>(a.rawSize, 3);
    if (!size) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("--raw-size takes three counts, such as 64x64x93; found '{}'", a.rawSize));
    }
    layout.size = {(*size)[0], (*size)[1], (*size)[2]};
    if (!a.rawSpacing.empty()) {
        const auto spacing = numbersBetweenX<double>(a.rawSpacing, 3);
        if (!spacing) {
            return fail(
                ErrorCode::InvalidArgument,
                fmt::format("--raw-spacing takes three distances in mm, such as 0.5x0.5x1.25; found '{}'",
                            a.rawSpacing));
        }
        layout.spacingMm = {(*spacing)[0], (*spacing)[1], (*spacing)[2]};
    }
    if (!a.rawEndian.empty() && a.rawEndian != "little" && a.rawEndian != "big") {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("--raw-endian is little or big; found '{}'", a.rawEndian));
    }
    layout.bigEndian = a.rawEndian == "big";
    if (!a.rawType.empty()) layout.type = a.rawType;
    layout.components = a.rawComponents.value_or(layout.components);
    layout.headerBytes = a.rawHeader.value_or(layout.headerBytes);
    layout.slope = a.rawSlope.value_or(layout.slope);
    layout.intercept = a.rawIntercept.value_or(layout.intercept);
    layout.unit = a.rawUnit;
    return layout;
}

Result<io::LoadedScene> openInput(const InputArguments& input, const LookArguments& look) {
    auto raw = rawLayout(input);
    if (!raw) return tl::unexpected(raw.error());
    io::LoadOptions options;
    options.raw = std::move(*raw);
    options.seriesUid = input.seriesUid;
    options.progress = consoleProgress();
    Result<io::LoadedScene> loaded = io::open({input.paths.begin(), input.paths.end()}, options);
    if (!loaded) return loaded;
    for (const VolumePtr& volume : loaded->volumes) printWarnings(*volume);
    Result<Scene> scene = withLook(std::move(loaded->scene), look);
    if (!scene) return tl::unexpected(scene.error());
    loaded->scene = std::move(*scene);
    return loaded;
}

}  // namespace pellucid::app
