// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "renderer/plan/plan.h"

namespace pellucid::renderer {

namespace {

std::string sizeText(std::uint64_t bytes) {
    if (bytes >= 10u << 20) return fmt::format("{:.1f} MB", static_cast<double>(bytes) / (1 << 20));
    if (bytes >= 10u << 10) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / (1 << 10));
    return fmt::format("{} B", bytes);
}

}  // namespace

std::string planText(const Plan& plan) {
    std::string text = "stages\n";
    for (const auto& row : plan.stages)
        text += fmt::format("  {:<12} {:<22} {}\n", row.stage, row.variant, row.reason);
    text += "passes\n";
    for (const auto& row : plan.passes)
        text += fmt::format("  {:<15} {:<22} {:>10}  {}\n", row.name, row.target, sizeText(row.bytes),
                            row.reason);
    text += "resources\n";
    for (const auto& row : plan.resources)
        text +=
            fmt::format("  {:<15} {:<22} {:>10}  {}\n", row.name, row.kind, sizeText(row.bytes), row.reason);
    text += "left out\n";
    for (const auto& row : plan.leftOut) text += fmt::format("  {:<15} {}\n", row.what, row.reason);
    if (!plan.automatic.empty()) text += plan.automatic + "\n";
    text += fmt::format("step {:g} mm, at most {:.0f} samples a ray\n", plan.stepMm, plan.samplesPerRay);
    if (plan.slabs > 1) text += fmt::format("rays drawn in {} slabs, from front to back\n", plan.slabs);
    if (plan.earlyTerminationBound > 0.0)
        text += fmt::format("early termination changes a pixel by at most {:.2g} ({:.2f} grey levels)\n",
                            plan.earlyTerminationBound, plan.earlyTerminationBound * 255.0);
    text += fmt::format("GPU memory {}\n", sizeText(plan.totalBytes));
    text += fmt::format(
        "main memory {} beside the program and its driver; where the driver draws on the processor, the GPU "
        "memory too: {}, {:.2f} times the stored volume\n",
        sizeText(plan.mainBytes), sizeText(plan.mainBytes + plan.totalBytes),
        static_cast<double>(plan.mainBytes + plan.totalBytes) / static_cast<double>(plan.volumeBytes));
    return text;
}

nlohmann::ordered_json planJson(const Plan& plan) {
    using Json = nlohmann::ordered_json;
    Json json;
    const auto list = [&](const char* key, const auto& rows, auto&& toJson) {
        json[key] = Json::array();
        for (const auto& row : rows) json[key].push_back(toJson(row));
    };
    list("stages", plan.stages, [](const StageRow& row) {
        return Json{{"stage", row.stage}, {"variant", row.variant}, {"reason", row.reason}};
    });
    list("passes", plan.passes, [](const PassRow& row) {
        return Json{{"pass", row.name}, {"target", row.target}, {"bytes", row.bytes}, {"reason", row.reason}};
    });
    list("resources", plan.resources, [](const ResourceRow& row) {
        return Json{{"resource", row.name}, {"kind", row.kind}, {"bytes", row.bytes}, {"reason", row.reason}};
    });
    list("leftOut", plan.leftOut, [](const LeftOutRow& row) {
        return Json{{"what", row.what}, {"reason", row.reason}};
    });
    if (!plan.automatic.empty()) json["automatic"] = plan.automatic;
    json["stepMm"] = plan.stepMm;
    json["samplesPerRay"] = plan.samplesPerRay;
    json["slabs"] = plan.slabs;
    json["earlyTerminationBound"] = plan.earlyTerminationBound;
    json["tableWorstError"] = plan.table.worstError;
    json["totalBytes"] = plan.totalBytes;
    json["mainBytes"] = plan.mainBytes;
    json["volumeBytes"] = plan.volumeBytes;
    return json;
}

}  // namespace pellucid::renderer
