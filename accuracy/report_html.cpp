// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/report_figures.h"
#include "accuracy/report_plan.h"
#include "accuracy/report_reference.h"
#include "accuracy/report_run.h"

namespace pellucid::accuracy {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body{font:15px/1.5 "DejaVu Sans",system-ui,sans-serif;color:#20242a;background:#fbfbf9;max-width:60rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.7rem;font-weight:600;margin:0}h2{font-size:1.2rem;font-weight:600;margin:2.4rem 0 .3rem}
p{margin:.4rem 0;max-width:48rem}.quiet{color:#666c75}
table{border-collapse:collapse;margin:.8rem 0;font-size:13px}th,td{padding:.2rem .7rem;text-align:right;border-bottom:1px solid #e6e6e0}
th{font-weight:600;color:#4a5058}th:first-child,td:first-child,td.text,th.text{text-align:left}td.best{background:#e9f3ec}
.wide{overflow-x:auto}.pictures{display:flex;flex-wrap:wrap;gap:1.2rem}figure{margin:0;width:17rem}
figure img{width:8.3rem;image-rendering:pixelated;background:#000;vertical-align:top}figcaption{font-size:12px;color:#4a5058}
svg{width:100%;height:auto;font:12px "DejaVu Sans",system-ui,sans-serif;fill:#4a5058}
.grid{stroke:#e8e8e2;fill:none}.axis{stroke:#8a8f98;fill:none}.level{stroke:#b9bcb4;stroke-dasharray:2 4;fill:none}
.guide{stroke:#8a8f98;fill:none}.curve{fill:none;stroke-width:1.8}.mid{text-anchor:middle}.end{text-anchor:end}.title{fill:#20242a}.note{font-size:11px}
dl{display:grid;grid-template-columns:8rem 1fr;gap:.1rem 1rem;font-size:13px}dt{color:#666c75}dd{margin:0}
</style>
)";

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
    std::string html = "<tr>";
    for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, cell);
    return html + "</tr>\n";
}

std::string table(const std::vector<std::string>& head, const std::string& rows) {
    return "<div class=\"wide\"><table><thead>" + row(head, "th") + "</thead><tbody>\n" + rows +
           "</tbody></table></div>\n";
}

std::string heading(const char* id, const char* text) {
    return fmt::format("<h2 id=\"{}\">{}</h2>\n", id, text);
}

std::string msText(double ms) {
    return ms < 100.0 ? fmt::format("{:.1f}", ms) : fmt::format("{:.0f}", ms);
}

std::string intro(const ReportData& data) {
    const std::string title = "Error and run time of " + escaped(data.name);
    std::string html =
        std::string(kHead) + "<title>" + title + "</title></head><body>\n<h1>" + title + "</h1>\n";
    html += fmt::format(
        "<p class=\"quiet\">{} of {} settings, pictures of {} x {} pixels. Errors are in units of what is "
        "shown "
        "(1 = full range, one grey level = 0.0039), over RGB.</p>\n<dl>",
        data.measurements.size(), data.planned, data.scope.pictureSize.x, data.scope.pictureSize.y);
    const auto fact = [&](const char* label, const std::string& text) {
        html += fmt::format("<dt>{}</dt><dd>{}</dd>", label, escaped(text));
    };
    fact("Scene", fmt::format("{} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm, hash {}", data.voxels.x,
                              data.voxels.y, data.voxels.z, data.spacingMm.x, data.spacingMm.y,
                              data.spacingMm.z, data.sceneHash));
    fact("Machine",
         fmt::format("{}, {} cores, {}", data.machine.cpu, data.machine.cores, data.machine.system));
    fact("Driver", data.machine.driver + (data.machine.software ? " (in software)" : ""));
    fact("Build", data.machine.build);
    fact("Rays",
         fmt::format("end when at most {:g} of the light can still pass, so that errors are the integrator's",
                     kReportTermination));
    std::string reached;
    for (const ReferenceFacts& r : data.references)
        reached +=
            fmt::format("; {} {:.1e} (RMSE {:.1e})", referenceName(r.kind), r.reachedBound, r.reachedRmse);
    if (!reached.empty())
        fact("References", "last two pictures, at half the step, differ by at most" + reached.substr(1) +
                               "; smaller errors than these say nothing");
    html += "</dl>\n";
    for (const std::string& note : data.notes) html += "<p>" + escaped(note) + "</p>\n";
    if (!data.scope.reductions.empty()) {
        html += "<p class=\"quiet\">Made quickly:";
        for (const std::string& reduction : data.scope.reductions) html += " " + escaped(reduction);
        html += "</p>\n";
    }
    return html;
}

std::string timeToErrorTable(const ReportAnalysis& analysis) {
    std::vector<std::string> head{"setting"};
    std::vector<double> best;
    for (std::size_t l = 0; l < std::size(kErrorLevels); ++l) {
        head.push_back(fmt::format("{:g}", kErrorLevels[l]));
        best.push_back(INFINITY);
        for (const ReportSeries& s : analysis.series)
            if (s.timesToError[l]) best.back() = std::min(best.back(), s.timesToError[l]->ms);
    }
    std::string rows, none;
    for (const ReportSeries& s : analysis.series) {
        if (std::none_of(s.timesToError.begin(), s.timesToError.end(),
                         [](const auto& time) { return time.has_value(); })) {
            none += (none.empty() ? "" : "; ") + s.name;
            continue;
        }
        rows += "<tr><td>" + escaped(s.name) + "</td>";
        for (std::size_t l = 0; l < best.size(); ++l) {
            const auto& time = s.timesToError[l];
            rows += fmt::format("<td{}>{}{}</td>", time && time->ms <= best[l] * 1.1 ? " class=\"best\"" : "",
                                time && time->atMost ? "&le; " : "", time ? msText(time->ms) : "&ndash;");
        }
        rows += "</tr>\n";
    }
    return heading("time-to-error", "Time to reach an error") +
           "<p>Milliseconds until the RMSE is at most the number above, between the measured steps "
           "interpolated in the logarithms. "
           "&le;: the cheapest setting measured is better already; &ndash;: not reached. Shaded: within a "
           "tenth of the "
           "fastest.</p>\n" +
           table(head, rows) +
           (none.empty() ? "" : "<p class=\"quiet\">None of these reached: " + escaped(none) + ".</p>\n");
}

std::string orderTable(const ReportAnalysis& analysis) {
    std::string rows;
    for (const ReportSeries& s : analysis.series)
        rows += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"text\">{}</td></tr>\n",
            escaped(s.name), s.order.order ? fmt::format("{:.2f}", *s.order.order) : "&ndash;",
            s.theory ? fmt::format("{:g}", *s.theory) : "&ndash;",
            s.order.points > 0 ? fmt::format("{}", s.order.points) : "&ndash;", escaped(s.remark));
    return heading("orders", "Order of convergence") +
           "<p>Least-squares slope of log RMSE over log step through the finest steps that lie on one line, "
           "beside the order that the "
           "method has where field and transfer function are smooth.</p>\n" +
           table({"setting", "observed", "theory", "points", "remark"}, rows);
}

std::string frontTables(const ReportData& data, const ReportAnalysis& analysis) {
    std::string html = heading("pareto", "Pareto front") +
                       "<p>Settings that no other one of the same filter beats in both time and error.</p>\n";
    for (std::size_t f = 0; f < analysis.fronts.size(); ++f) {
        std::string rows;
        for (const std::size_t i : analysis.fronts[f]) {
            const Measurement& m = data.measurements[i];
            rows += row({escaped(settingName(m.setting)), msText(m.wallMs), fmt::format("{:.2e}", m.rmse),
                         fmt::format("{:.2e}", m.maxError)});
        }
        if (!rows.empty()) html += table({"setting", "ms", "RMSE", "max"}, rows);
    }
    return html;
}

/// Whether the error that a method keeps below its tolerance is; importance steps bound the value along a ray
/// and promise nothing of the picture.
const char* isMet(const Measurement& m) {
    if (m.setting.integrator == Integrator::Importance && !m.setting.automatic) return "-";
    return 255.0 * (m.setting.automatic ? m.rmse : m.maxError) <= *m.setting.tolerance ? "yes" : "NO";
}

std::string toleranceTable(const ReportData& data) {
    std::string rows;
    for (const Measurement& m : data.measurements)
        if (m.setting.tolerance)
            rows += row({escaped(seriesName(m.setting)), fmt::format("{:g}", *m.setting.tolerance),
                         fmt::format("{:.2f}", 255.0 * m.maxError), fmt::format("{:.3f}", 255.0 * m.rmse),
                         msText(m.wallMs), isMet(m)});
    if (rows.empty()) return {};
    return heading("tolerances", "Tolerances") +
           "<p>Grey levels asked for and found. The adaptive integrator keeps the largest error below the "
           "tolerance, automatic the RMSE; importance steps bound the value along a ray, not the picture. "
           "Times of automatic "
           "hold the estimates that it checks itself with.</p>\n" +
           table({"setting", "asked", "max", "RMSE", "ms", "met"}, rows);
}

std::string stallTable(const ReportData& data) {
    std::string rows;
    for (const Stall& s : data.stalls)
        rows += row({name(s.accumulation), fmt::format("{:g}", s.layerOpacity), fmt::format("{}", s.layers),
                     fmt::format("{:.4f}", s.exact), fmt::format("{:.4f}", s.predicted),
                     fmt::format("{:.4f}", s.drawn)});
    return heading("stalls", "Stalls of the accumulation formats") +
           "<p>The opacity A of many faint layers of opacity a in front of each other: each layer adds "
           "a (1 - A). A format that rounds to nearest keeps A as it is once that is less than half the "
           "distance u to the next number it holds, so A stops at 1 - u / (2 a), however many layers "
           "follow: u = 1/255 in 8 bits, 2^-11 in half floats between 1/2 and 1. Where 1 - u / (2 a) is "
           "below 0, not even the first layer is seen. 32-bit floats (u = 2^-24) reach the exact value "
           "here. In the plot of the formats above the same shows as curves that rise again to the left."
           "</p>\n" +
           table({"format", "opacity of a layer", "layers", "exact", "predicted", "drawn"}, rows);
}

std::string referenceTable(const ReportData& data) {
    std::string rows;
    for (const ReferenceFacts& r : data.references)
        rows += row({referenceName(r.kind), fmt::format("{:.1e}", r.reachedBound),
                     fmt::format("{:.1e}", r.reachedRmse), fmt::format("{:.4g}", r.stepMm),
                     fmt::format("{:.1f}", r.ms / 1000.0)});
    return heading("references", "References") +
           "<p>Drawn in double precision on the processor by independent code, the step halved until two "
           "pictures differ by "
           "less than a bound. Each filter has its own; VTK's volume ends at the outer voxel centres, half a "
           "voxel inside ours, and so its pictures have one too.</p>\n" +
           table({"filter", "largest difference of the last two", "their RMSE", "step, mm", "s"}, rows);
}

/// Neighbours in the plan with the same reason share a line.
std::string leftOutTable(const ReportData& data) {
    if (data.leftOut.empty()) return {};
    std::string rows;
    for (std::size_t i = 0; i < data.leftOut.size();) {
        std::size_t end = i + 1;
        while (end < data.leftOut.size() && data.leftOut[end].why == data.leftOut[i].why) ++end;
        const std::string first = settingName(data.leftOut[i].setting);
        const std::string last = settingName(data.leftOut[end - 1].setting);
        rows += fmt::format("<tr><td>{}{}</td><td>{}</td><td class=\"text\">{}</td></tr>\n", escaped(first),
                            end - i > 1 ? " &hellip; " + escaped(last) : "", end - i,
                            escaped(data.leftOut[i].why));
        i = end;
    }
    return heading("left-out", "Left out") +
           fmt::format(
               "<p>Settings that were not measured: a frame may take {:g} s, a reference {:g} min. "
               "Expected from the same curve's longer steps, and from a small reference.</p>\n",
               data.scope.mostFrameSeconds, data.scope.mostReferenceSeconds / 60.0) +
           table({"from &hellip; to", "settings", "why"}, rows);
}

std::string measurementTable(const ReportData& data) {
    std::string rows;
    for (const Measurement& m : data.measurements)
        rows += row({escaped(settingName(m.setting)), msText(m.firstMs), msText(m.wallMs),
                     m.gpuMs ? msText(*m.gpuMs) : "&ndash;", fmt::format("{}", m.warmFrames),
                     m.bytes ? fmt::format("{:.2f}", static_cast<double>(*m.bytes) / 0x1p20) : "&ndash;",
                     fmt::format("{:.2e}", m.maxError), fmt::format("{:.2e}", m.rmse),
                     std::isfinite(m.psnr) ? fmt::format("{:.1f}", m.psnr) : "&infin;",
                     fmt::format("{:.5f}", m.ssim)});
    return heading("measurements", "All measurements") + "<p>" +
           "The first frame compiles, uploads and builds tables where no setting before it did; GPU time "
           "is that of the draws alone" +
           (data.machine.software
                ? ", which this software driver's timer does not tell: it is the wall clock "
                  "around them"
                : "") +
           ". Wall and GPU times are medians of so many warm frames. Memory is what the plan allots.</p>\n" +
           table({"setting", "first, ms", "wall, ms", "GPU, ms", "frames", "MiB", "max", "RMSE", "PSNR, dB",
                  "SSIM"},
                 rows);
}

std::string base64(std::string_view bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63u];
    }
    return text;
}

std::string image(const ReadPicture& readPicture, const std::string& file, const std::string& alt) {
    const auto bytes = readPicture(file);
    if (!bytes) return {};
    return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(alt), base64(*bytes));
}

std::string pictures(const ReportData& data, const ReadPicture& readPicture) {
    std::string html;
    const auto figure = [&](const std::string& images, const std::string& caption) {
        if (!images.empty())
            html += "<figure>" + images + "<figcaption>" + caption + "</figcaption></figure>\n";
    };
    const Filter own = data.scope.filters.front();
    for (const ReferenceFacts& r : data.references)
        if (r.kind.filter == own || r.kind.peers)
            figure(image(readPicture, referenceFile(r.kind), "reference"),
                   "Reference, " + referenceName(r.kind));
    for (const Measurement& m : data.measurements) {
        if (!isShown(m.setting, data.scope)) continue;
        const std::string name = settingName(m.setting);
        figure(image(readPicture, pictureFile(m.setting), name) +
                   image(readPicture, differenceFile(m.setting), "difference of " + name),
               fmt::format("{}<br>RMSE {:.2e}, max {:.2e}", escaped(name), m.rmse, m.maxError));
    }
    return heading("differences", "Pictures and differences") +
           fmt::format(
               "<p>Left what is drawn, right its absolute difference to the reference, {:g} times as bright: "
               "white is {:.1f} grey levels or more.</p>\n<div class=\"pictures\">\n",
               kDifferenceGain, 255.0 / kDifferenceGain) +
           html + "</div>\n";
}

}  // namespace

std::string reportHtml(const ReportData& data, const ReportAnalysis& analysis,
                       const ReadPicture& readPicture) {
    std::string html = intro(data);
    const std::vector<ReportFigure> figures = reportFigures(data, analysis);
    for (const ReportFigure& figure : figures) {
        html += fmt::format("<h2>{}</h2>\n<p>{}</p>\n{}", figure.title, figure.text, svgOf(figure.plot));
        if (figure.plot.id == "work-precision") html += timeToErrorTable(analysis);
    }
    html += orderTable(analysis) + frontTables(data, analysis) + toleranceTable(data) + stallTable(data) +
            pictures(data, readPicture) + referenceTable(data) + leftOutTable(data) + measurementTable(data);
    return html + "</body></html>\n";
}

}  // namespace pellucid::accuracy
