// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "scene/json_parse.h"
#include "scene/json_reader.h"
#include "scene/scene_json.h"
#include "scene/scene_json_parts.h"

namespace pellucid {

namespace {

using nlohmann::json;

Result<std::vector<std::string>> splitPath(std::string_view path) {
    std::vector<std::string> keys;
    for (std::string_view rest = path;;) {
        const std::size_t dot = rest.find('.');
        keys.emplace_back(rest.substr(0, dot));
        if (keys.back().empty() || keys.size() > 64)
            return fail(
                ErrorCode::InvalidArgument,
                fmt::format("\"{}\" is no path of a setting; write it like camera.fovDeg or volumes.0.filter",
                            path.substr(0, 200)));
        if (dot == rest.npos) return keys;
        rest.remove_prefix(dot + 1);
    }
}

std::optional<std::size_t> asIndex(const std::string& key) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (error != std::errc{} || end != key.data() + key.size()) return std::nullopt;
    return index;
}

/// The text of a setting as a value: JSON where it is JSON, else a word.
Result<json> settingValue(std::string_view text) {
    Result<json> value = parseJson(text);
    if (!value && value.error().code == ErrorCode::Corrupt) return json(std::string(text));
    return value;
}

/// The member of an object or the element of an array; one past the end appends.
Result<json*> step(json& parent, const std::string& key, const std::string& pointer) {
    if (parent.is_null()) parent = asIndex(key) ? json::array() : json::object();
    if (parent.is_object()) return &parent[key];
    if (!parent.is_array())
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("{}: found {}, which has no member \"{}\"", pointer, foundText(parent), key));
    const auto index = asIndex(key);
    if (!index || *index > parent.size())
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("{}: found index \"{}\", allowed is 0 to {}", pointer, key, parent.size()));
    if (*index == parent.size()) parent.push_back(nullptr);
    return &parent[*index];
}

/// Two ways to write one fact: setting one replaces the other.
void replaceAlternative(json& parent, const std::string& key) {
    if (!parent.is_object()) return;
    // As when read from a file: an error asked for lets the program choose, a step or integrator does not.
    // Integrators that keep to a tolerance themselves are given it.
    if (key == "toleranceGreyLevels") {
        const auto integrator = enumFromName<Integrator>(parent.value("integrator", ""));
        parent["automatic"] = !integrator || !keepsTolerance(*integrator);
    }
    if (key == "stepVoxels" || key == "stepMm" || key == "integrator") parent.erase("automatic");
    if (key == "preset") parent.erase("transferFunction");
    if (key == "opacity") parent.erase("extinction");
}

}  // namespace

Result<Scene> withSetting(const Scene& scene, std::string_view dottedPath, std::string_view value) {
    const auto keys = splitPath(dottedPath);
    if (!keys) return tl::unexpected(keys.error());
    Result<json> wanted = settingValue(value);
    if (!wanted) return fail(wanted.error(), fmt::format("value of {}", dottedPath));

    json document = toFullJson(scene);
    json* place = &document;
    json* parent = nullptr;
    std::string pointer;
    for (const std::string& key : *keys) {
        parent = place;
        Result<json*> next = step(*parent, key, pointer);
        if (!next) return tl::unexpected(next.error());
        place = *next;
        pointer = jsonPointer(pointer, key);
    }
    if (wanted->is_null() && parent->is_object()) {
        parent->erase(keys->back());  // Back to the default, or to what follows from the data.
    } else {
        *place = std::move(*wanted);
        replaceAlternative(*parent, keys->back());
    }
    return sceneFromJson(document);
}

}  // namespace pellucid
