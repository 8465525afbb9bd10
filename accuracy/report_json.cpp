// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "accuracy/report_plan.h"
#include "accuracy/report_reference.h"

namespace pellucid::accuracy {
namespace {

using Json = nlohmann::json;

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

template <class E>
Json namesOf(const std::vector<E>& values) {
    Json list = Json::array();
    for (const E value : values) list.push_back(name(value));
    return list;
}

Json settingJson(const ReportSetting& s) {
    return {{"renderer", s.renderer},
            {"integrator", name(s.integrator)},
            {"filter", name(s.filter)},
            {"accumulation", name(s.accumulation)},
            {"jitter", s.jitter},
            {"stepVoxels", s.stepVoxels},
            {"toleranceGreyLevels", orNull(s.tolerance)},
            {"automatic", s.automatic}};
}

std::optional<ReportSetting> settingFromJson(const Json& json) {
    const auto integrator = enumFromName<Integrator>(json.value("integrator", ""));
    const auto filter = enumFromName<Filter>(json.value("filter", ""));
    const auto accumulation = enumFromName<Accumulation>(json.value("accumulation", ""));
    if (!integrator || !filter || !accumulation) return std::nullopt;
    ReportSetting s{json.at("renderer").get<std::string>(),
                    *integrator,
                    *filter,
                    *accumulation,
                    json.at("jitter").get<bool>(),
                    json.at("stepVoxels").get<double>(),
                    std::nullopt,
                    json.at("automatic").get<bool>()};
    if (json.at("toleranceGreyLevels").is_number())
        s.tolerance = json.at("toleranceGreyLevels").get<double>();
    return s;
}

Json scopeJson(const ReportScope& scope) {
    return {{"integrators", namesOf(scope.integrators)},
            {"filters", namesOf(scope.filters)},
            {"accumulations", namesOf(scope.accumulations)},
            {"stepsVoxels", scope.steps},
            {"tolerancesGreyLevels", scope.tolerances},
            {"pictureSize", {scope.pictureSize.x, scope.pictureSize.y}},
            {"warmFrames", scope.warmFrames},
            {"earlyTermination", kReportTermination},
            {"peers", scope.peers},
            {"mostFrameSeconds", scope.mostFrameSeconds},
            {"mostReferenceSeconds", scope.mostReferenceSeconds},
            {"reductions", scope.reductions}};
}

Json timesToErrorJson(const ReportSeries& series) {
    Json list = Json::array();
    for (std::size_t i = 0; i < series.timesToError.size(); ++i) {
        const auto& time = series.timesToError[i];
        list.push_back({{"rmse", kErrorLevels[i]},
                        {"wallMs", time ? Json(time->ms) : Json()},
                        {"atMost", time && time->atMost}});
    }
    return list;
}

Json seriesJson(const ReportData& data, const ReportSeries& series) {
    Json members = Json::array();
    for (const std::size_t i : series.members) members.push_back(settingName(data.measurements[i].setting));
    return {{"name", series.name},
            {"settings", members},
            {"observedOrder", orNull(series.order.order)},
            {"orderPoints", series.order.points},
            {"theoreticalOrder", orNull(series.theory)},
            {"remark", series.remark},
            {"time", {{"toError", timesToErrorJson(series)}}}};
}

Json frontsJson(const ReportData& data, const ReportAnalysis& analysis) {
    Json fronts = Json::object();
    for (std::size_t f = 0; f < analysis.fronts.size(); ++f) {
        Json& list = fronts[name(data.scope.filters[f])] = Json::array();
        for (const std::size_t i : analysis.fronts[f])
            list.push_back(settingName(data.measurements[i].setting));
    }
    return fronts;
}

}  // namespace

Json measurementJson(const Measurement& m) {
    Json json{{"setting", settingJson(m.setting)}, {"stepMm", m.stepMm}};
    json["time"] = {{"firstMs", m.firstMs},
                    {"wallMs", m.wallMs},
                    {"gpuMs", orNull(m.gpuMs)},
                    {"warmFrames", m.warmFrames}};
    // What automatic chooses follows from times, and with it all else.
    Json& found = m.setting.automatic ? json["time"] : json;
    found["bytes"] = orNull(m.bytes);
    found["error"] = {{"max", m.maxError},
                      {"rmse", m.rmse},
                      {"psnr", std::isfinite(m.psnr) ? Json(m.psnr) : Json()},
                      {"ssim", m.ssim}};
    return json;
}

std::optional<Measurement> measurementFromJson(const Json& json) {
    try {
        const auto setting = settingFromJson(json.at("setting"));
        if (!setting) return std::nullopt;
        const Json& time = json.at("time");
        const Json& found = setting->automatic ? time : json;
        const Json& error = found.at("error");
        Measurement m;
        m.setting = *setting;
        m.stepMm = json.at("stepMm").get<double>();
        if (found.at("bytes").is_number()) m.bytes = found.at("bytes").get<std::uint64_t>();
        m.firstMs = time.at("firstMs").get<double>();
        m.wallMs = time.at("wallMs").get<double>();
        if (time.at("gpuMs").is_number()) m.gpuMs = time.at("gpuMs").get<double>();
        m.warmFrames = time.at("warmFrames").get<int>();
        // JSON has no NaN: a picture with one has null errors.
        const auto number = [](const Json& value, double otherwise) {
            return value.is_number() ? value.get<double>() : otherwise;
        };
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        m.maxError = number(error.at("max"), kNaN);
        m.rmse = number(error.at("rmse"), kNaN);
        m.ssim = number(error.at("ssim"), kNaN);
        m.psnr = number(error.at("psnr"), m.rmse == 0.0 ? std::numeric_limits<double>::infinity() : kNaN);
        return m;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

Json stallsJson(const std::vector<Stall>& stalls) {
    Json list = Json::array();
    for (const Stall& s : stalls)
        list.push_back({{"accumulation", name(s.accumulation)},
                        {"layerOpacity", s.layerOpacity},
                        {"layers", s.layers},
                        {"exact", s.exact},
                        {"predicted", s.predicted},
                        {"drawn", s.drawn}});
    return list;
}

std::vector<Stall> stallsFromJson(const Json& json) {
    std::vector<Stall> stalls;
    for (const Json& s : json) {
        const auto accumulation = enumFromName<Accumulation>(s.value("accumulation", ""));
        if (accumulation)
            stalls.push_back({*accumulation, s.value("layerOpacity", 0.0), s.value("layers", 0),
                              s.value("exact", 0.0), s.value("predicted", 0.0), s.value("drawn", 0.0)});
    }
    return stalls;
}

Json reportJson(const ReportData& data, const ReportAnalysis& analysis) {
    Json references = Json::array();
    for (const ReferenceFacts& r : data.references)
        references.push_back({{"filter", name(r.kind.filter)},
                              {"name", referenceName(r.kind)},
                              {"reachedBound", r.reachedBound},
                              {"reachedRmse", r.reachedRmse},
                              {"stepMm", r.stepMm},
                              {"time", {{"ms", r.ms}}}});
    Json measurements = Json::array();
    for (const Measurement& m : data.measurements) {
        Json json = measurementJson(m);
        json["name"] = settingName(m.setting);
        measurements.push_back(json);
    }
    Json series = Json::array();
    for (const ReportSeries& s : analysis.series) series.push_back(seriesJson(data, s));
    Json leftOut = Json::array();
    for (const LeftOut& l : data.leftOut)
        leftOut.push_back({{"setting", settingName(l.setting)}, {"why", l.why}});
    return {{"pellucidReport", 1},
            {"scene",
             {{"name", data.name},
              {"hash", data.sceneHash},
              {"text", data.sceneText},
              {"voxels", {data.voxels.x, data.voxels.y, data.voxels.z}},
              {"spacingMm", {data.spacingMm.x, data.spacingMm.y, data.spacingMm.z}}}},
            {"machine",
             {{"cpu", data.machine.cpu},
              {"cores", data.machine.cores},
              {"system", data.machine.system},
              {"driver", data.machine.driver},
              {"software", data.machine.software},
              {"build", data.machine.build}}},
            {"scope", scopeJson(data.scope)},
            {"planned", data.planned},
            {"notes", data.notes},
            {"references", references},
            {"measurements", measurements},
            {"series", series},
            {"stalls", stallsJson(data.stalls)},
            {"time", {{"paretoFronts", frontsJson(data, analysis)}, {"leftOut", leftOut}}}};
}

std::string reportCsv(const ReportData& data, const ReportAnalysis& analysis) {
    std::string csv =
        "renderer,integrator,filter,accumulation,jitter,step_voxels,step_mm,tolerance_grey_levels,first_ms,"
        "wall_ms,gpu_ms,"
        "warm_frames,gpu_bytes,max_error,rmse,psnr_db,ssim,pareto\n";
    const auto optional = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string(); };
    for (std::size_t i = 0; i < data.measurements.size(); ++i) {
        const Measurement& m = data.measurements[i];
        const ReportSetting& s = m.setting;
        const bool onFront = std::any_of(
            analysis.fronts.begin(), analysis.fronts.end(),
            [i](const auto& front) { return std::find(front.begin(), front.end(), i) != front.end(); });
        csv += fmt::format("{},{},{},{},{},{},{},{},{:.4f},{:.4f},{},{},{},{},{},{},{},{}\n", s.renderer,
                           isPeer(s) ? "" : methodName(s), name(s.filter),
                           isPeer(s) ? "" : name(s.accumulation), s.jitter ? 1 : 0, s.stepVoxels, m.stepMm,
                           optional(s.tolerance), m.firstMs, m.wallMs, optional(m.gpuMs), m.warmFrames,
                           optional(m.bytes), m.maxError, m.rmse, m.psnr, m.ssim, onFront ? 1 : 0);
    }
    return csv;
}

}  // namespace pellucid::accuracy
