// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "io/atomic_file.h"
#include "io/text_scan.h"
#include "io/voxel_data.h"
#include "scene/scene_json.h"
#include "scene/utf8.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxSceneBytes = 64u << 20;
constexpr std::string_view kSeriesMark = "#series=";

/// A source is a path, for one DICOM series of several with "#series=UID" behind it.
struct Source {
    fs::path path;
    std::string seriesUid;
};

Source sourceFrom(const std::string& text) {
    const std::size_t mark = text.rfind(kSeriesMark);
    std::error_code error;
    if (mark == std::string::npos || fs::exists(text, error)) return {text, {}};
    return {text.substr(0, mark), text.substr(mark + kSeriesMark.size())};
}

std::string textFrom(const Source& source) {
    return source.seriesUid.empty()
               ? source.path.string()
               : fmt::format("{}{}{}", source.path.string(), kSeriesMark, source.seriesUid);
}

fs::path absolutePath(const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::absolute(path, error);
    return error ? path : whole.lexically_normal();
}

/// The part of the whole progress that one of several volumes has.
Progress partOf(const Progress& progress, std::size_t index, std::size_t count) {
    if (!progress) return {};
    return [=](double fraction, std::string_view what) {
        return progress((static_cast<double>(index) + fraction) / static_cast<double>(count), what);
    };
}

Result<VolumePtr> loadItem(const VolumeItem& item, std::size_t index, const LoadOptions& options) {
    if (item.source.empty())
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("/volumes/{}/source: missing; a path is needed", index));
    const Source source = sourceFrom(item.source);
    LoadOptions own = options;
    // The options are about data files given by hand; a scene says itself what it means.
    own.raw.reset();
    own.seriesUid = source.seriesUid;
    auto volume = loadVolume({source.path}, own);
    if (!volume) return fail(std::move(volume.error()), fmt::format("/volumes/{}/source", index));
    if (item.component >= (*volume)->components()) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("/volumes/{}/component: found {}, {} has {}", index, item.component,
                                item.source, (*volume)->components()));
    }
    return volume;
}

/// Relative to `folder` where both lie under a common folder that is not the root, else absolute.
std::string relativeSource(const std::string& text, const fs::path& folder) {
    if (text.empty()) return text;
    Source source = sourceFrom(text);
    const fs::path whole = absolutePath(source.path);
    const bool shared =
        std::distance(folder.begin(),
                      std::mismatch(folder.begin(), folder.end(), whole.begin(), whole.end()).first) > 1;
    source.path = shared ? whole.lexically_relative(folder) : whole;
    return textFrom(source);
}

/// What a scene names for paths given by hand: the file or folder, or the folder that all slices of a list
/// share.
Result<Source> sourceOf(const std::vector<fs::path>& paths, const LoadOptions& options) {
    Source source{absolutePath(paths.front()), options.seriesUid};
    if (paths.size() > 1) source.path = source.path.parent_path();
    if (!isUtf8(source.path.string())) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("the path {} is not UTF-8 and cannot be named in a scene",
                                shown(shownPath(source.path), 255)));
    }
    return source;
}

}  // namespace

bool looksLikeScene(const fs::path& file) {
    const std::string start = firstBytes(file, 1 << 16, false);
    return trimmed(start).starts_with('{') && start.find("\"pellucid\"") != std::string::npos;
}

Result<LoadedScene> loadScene(const fs::path& file, const LoadOptions& options) {
    const auto bytes = readFile(file, kMaxSceneBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    auto scene = sceneFromText({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!scene) return fail(std::move(scene.error()), shownPath(file));
    LoadedScene loaded{std::move(*scene), {}};
    const fs::path folder = absolutePath(file).parent_path();
    std::map<std::string, VolumePtr> bySource;  // two items of one source share its voxels
    const std::size_t count = loaded.scene.volumes.size();
    for (std::size_t i = 0; i < count; ++i) {
        VolumeItem& item = loaded.scene.volumes[i];
        // In memory sources are absolute, so that a scene can be saved to another folder.
        if (!item.source.empty()) item.source = (folder / fs::path(item.source)).lexically_normal().string();
        LoadOptions own = options;
        own.progress = partOf(options.progress, i, count);
        own.coarse = {};  // A coarse copy of one volume is not the scene.
        const auto known = bySource.find(item.source);
        if (known != bySource.end() && item.component < known->second->components()) {
            loaded.volumes.push_back(known->second);
            continue;
        }
        auto volume = loadItem(item, i, own);
        if (!volume) return fail(std::move(volume.error()), shownPath(file));
        if (item.name.empty()) item.name = (*volume)->info().name;
        bySource.emplace(item.source, *volume);
        loaded.volumes.push_back(std::move(*volume));
    }
    return loaded;
}

Result<LoadedScene> open(const std::vector<fs::path>& paths, const LoadOptions& options) {
    if (paths.empty()) return fail(ErrorCode::InvalidArgument, "no file was given");
    if (paths.size() == 1 && !options.raw && looksLikeScene(paths.front()))
        return loadScene(paths.front(), options);
    const auto volume = loadVolume(paths, options);
    if (!volume) return tl::unexpected(volume.error());
    const auto source = sourceOf(paths, options);
    if (!source) return tl::unexpected(source.error());
    LoadedScene loaded;
    VolumeItem item;
    item.name = (*volume)->info().name;
    item.source = textFrom(*source);
    loaded.scene.volumes.push_back(std::move(item));
    loaded.volumes.push_back(*volume);
    return loaded;
}

Result<void> saveScene(const fs::path& file, const Scene& scene) {
    Scene written = scene;
    const fs::path folder = absolutePath(file).parent_path();
    for (VolumeItem& item : written.volumes) item.source = relativeSource(item.source, folder);
    const std::string text = sceneText(written);
    return writeFile(file, std::as_bytes(std::span(text)));
}

}  // namespace pellucid::io
