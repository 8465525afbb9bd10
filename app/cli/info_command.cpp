// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/arguments.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"

namespace pellucid::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kAxes = {"i", "j", "k"};

glm::dvec3 axisDirection(const Grid& grid, int axis) {
    return glm::dvec3(grid.patientFromIndex[axis]) / spacingMm(grid)[axis];
}

Json list(glm::dvec3 v) {
    return {v.x, v.y, v.z};
}

/// Extent of the outer corners in the patient frame.
std::pair<glm::dvec3, glm::dvec3> boundsMm(const Grid& grid) {
    const auto corners = cornersMm(grid);
    std::pair<glm::dvec3, glm::dvec3> bounds{corners[0], corners[0]};
    for (const glm::dvec3& corner : corners) {
        bounds.first = glm::min(bounds.first, corner);
        bounds.second = glm::max(bounds.second, corner);
    }
    return bounds;
}

/// All that is known of a volume; the text form is made from this too, so both say the same.
Json describe(const Volume& volume) {
    const Grid& grid = volume.grid();
    const auto [low, high] = boundsMm(grid);
    Json json;
    json["name"] = volume.info().name;
    json["modality"] = volume.info().modality;
    json["size"] = {grid.size.x, grid.size.y, grid.size.z};
    json["spacingMm"] = list(spacingMm(grid));
    json["originMm"] = list(transformPoint(grid.patientFromIndex, glm::dvec3(0.0)));
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 direction = axisDirection(grid, axis);
        json["axes"].push_back({{"axis", kAxes[axis]},
                                {"direction", list(direction)},
                                {"towards", orientationLetters(direction)}});
    }
    json["sheared"] = isSheared(grid);
    json["boundsMm"] = {{"low", list(low)}, {"high", list(high)}};
    json["type"] = name(volume.type());
    json["components"] = volume.components();
    json["bytes"] = volume.bytes().size();
    json["slope"] = volume.mapping().slope;
    json["intercept"] = volume.mapping().intercept;
    json["unit"] = volume.mapping().unit;
    for (int component = 0; component < volume.components(); ++component) {
        const ValueRange stored = volume.storedRange(component);
        const ValueRange physical = volume.physicalRange(component);
        json["ranges"].push_back(
            {{"stored", {stored.lo, stored.hi}}, {"physical", {physical.lo, physical.hi}}});
    }
    json["nonFinite"] = volume.nonFiniteCount();
    json["windows"] = Json::array();
    for (const NamedWindow& named : volume.info().windows) {
        json["windows"].push_back(
            {{"name", named.name}, {"level", named.window.level}, {"width", named.window.width}});
    }
    json["facts"] = Json::object();
    for (const auto& [label, text] : volume.info().facts) json["facts"][label] = text;
    json["warnings"] = Json::array();
    for (const Warning& warning : volume.info().warnings) json["warnings"].push_back(warning.message);
    return json;
}

std::string triple(const Json& list, std::string_view separator = ", ") {
    return fmt::format("{:.6g}{}{:.6g}{}{:.6g}", list[0].get<double>(), separator, list[1].get<double>(),
                       separator, list[2].get<double>());
}

void row(std::string_view label, const std::string& text) {
    fmt::print("  {:<14} {}\n", label, text);
}

void printGeometry(const Json& json) {
    row("size", fmt::format("{} voxels, {:.1f} MB", triple(json["size"], " x "),
                            static_cast<double>(json["bytes"].get<std::uint64_t>()) * 1e-6));
    row("spacing",
        fmt::format("{} mm{}", triple(json["spacingMm"], " x "),
                    json["sheared"].get<bool>() ? ", sheared (the axes are not perpendicular)" : ""));
    row("first voxel", fmt::format("at {} mm (LPS)", triple(json["originMm"])));
    for (const Json& axis : json["axes"]) {
        row(fmt::format("axis {}", axis["axis"].get<std::string>()),
            fmt::format("towards {} ({})", axis["towards"].get<std::string>(), triple(axis["direction"])));
    }
    row("extent",
        fmt::format("{} to {} mm", triple(json["boundsMm"]["low"]), triple(json["boundsMm"]["high"])));
}

void printValues(const Json& json) {
    const std::string unit = json["unit"].get<std::string>();
    const auto components = json["components"].get<int>();
    row("stored as", fmt::format("{}{}", json["type"].get<std::string>(),
                                 components == 1 ? "" : fmt::format(", {} components", components)));
    row("value", fmt::format("stored * {:.10g} + {:.10g}{}", json["slope"].get<double>(),
                             json["intercept"].get<double>(), unit.empty() ? "" : " " + unit));
    for (const Json& range : json["ranges"]) {
        row("range", fmt::format("{:.10g} to {:.10g}{} (stored {:.10g} to {:.10g})",
                                 range["physical"][0].get<double>(), range["physical"][1].get<double>(),
                                 unit.empty() ? "" : " " + unit, range["stored"][0].get<double>(),
                                 range["stored"][1].get<double>()));
    }
    if (const auto nonFinite = json["nonFinite"].get<std::uint64_t>(); nonFinite > 0) {
        row("not finite",
            fmt::format("{} values are NaN or infinite; drawn as the smallest value", nonFinite));
    }
    for (const Json& window : json["windows"]) {
        row("window", fmt::format("level {:.6g}, width {:.6g} {}", window["level"].get<double>(),
                                  window["width"].get<double>(), window["name"].get<std::string>()));
    }
}

/// Facts of a format repeat what every volume has; the text says it once.
bool isSaidAlready(const std::string& label) {
    static constexpr std::array<std::string_view, 4> kSaid = {"size", "spacing", "type", "orientation"};
    std::string lower = label;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return std::find(kSaid.begin(), kSaid.end(), lower) != kSaid.end();
}

void printText(const Json& json) {
    const std::string modality = json["modality"].get<std::string>();
    fmt::print("{}{}\n", json["name"].get<std::string>(), modality.empty() ? "" : ", " + modality);
    printGeometry(json);
    printValues(json);
    for (const auto& [label, text] : json["facts"].items()) {
        if (!isSaidAlready(label)) row(label, text.get<std::string>());
    }
    for (const Json& warning : json["warnings"]) row("warning", warning.get<std::string>());
}

struct InfoArguments {
    InputArguments input;
    bool json = false;
};

int run(const InfoArguments& arguments) {
    auto raw = rawLayout(arguments.input);
    if (!raw) return report(raw.error());
    io::LoadOptions options;
    options.raw = std::move(*raw);
    options.seriesUid = arguments.input.seriesUid;
    options.progress = consoleProgress();
    const auto& paths = arguments.input.paths;
    const Result<io::LoadedScene> loaded = io::open({paths.begin(), paths.end()}, options);
    if (!loaded) return report(loaded.error());
    clearProgress();
    Json volumes = Json::array();
    for (const VolumePtr& volume : loaded->volumes) volumes.push_back(describe(*volume));
    if (arguments.json) {
        // Names in files may hold bytes that are not UTF-8: shown as the replacement character rather than
        // refused.
        fmt::print("{}\n", Json{{"volumes", volumes}}.dump(2, ' ', false, Json::error_handler_t::replace));
    } else {
        for (const Json& volume : volumes) printText(volume);
    }
    return kExitOk;
}

}  // namespace

Command addInfoCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("info", "Tells the geometry, values and warnings of a scan");
    const auto arguments = std::make_shared<InfoArguments>();
    addInputOptions(*command, arguments->input);
    command->add_flag("--json", arguments->json, "For programs");
    command->footer(
        "Positions and directions are in the patient frame: x to the patient's left, y to the back, z to the "
        "head, in mm.\n\n"
        "Examples:\n"
        "  pellucid info ct-head/\n"
        "  pellucid info brain.nii.gz --json\n"
        "  pellucid info DICOMDIR --series 1.2.840.113619.2.1");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
