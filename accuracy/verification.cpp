// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/verification.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

namespace pellucid::accuracy {

namespace {

// Shares of the time, about.
constexpr double kStepSeconds = 40.0, kGridSeconds = 20.0, kPixelSeconds = 40.0, kExtremeSeconds = 10.0;

/// Progress of parts that follow each other, as that of the whole.
class Parts {
public:
    Parts(const Progress& progress, double seconds) : m_progress(progress), m_seconds(seconds) {}

    Progress next(double seconds) {
        const double from = m_done / m_seconds;
        m_done += seconds;
        return [this, from, share = seconds / m_seconds](double fraction, std::string_view what) {
            return goOn(m_progress, from + share * fraction, what);
        };
    }

private:
    const Progress& m_progress;
    double m_seconds;
    double m_done = 0.0;
};

}  // namespace

bool Verification::passed() const {
    return (!orders || allPassed(*orders)) && (!extremes || allPassed(*extremes));
}

Result<Verification> verify(renderer::Renderer& renderer, const VerificationParts& asked,
                            const Progress& progress,
                            const std::function<void(const VerificationLine&)>& found) {
    using Orders = Result<std::vector<OrderRow>> (*)(renderer::Renderer&, const Progress&, const OrderFound&);
    struct OrderPart {
        bool wanted;
        Orders run;
        double seconds;
    };
    const OrderPart orderParts[] = {{asked.step, verifyStepOrders, kStepSeconds},
                                    {asked.grid, verifyGridOrders, kGridSeconds},
                                    {asked.pixel, verifyPixelOrders, kPixelSeconds}};
    double seconds = asked.extreme ? kExtremeSeconds : 0.0;
    for (const OrderPart& part : orderParts) seconds += part.wanted ? part.seconds : 0.0;
    Parts parts(progress, seconds);
    const auto tell = [&](const auto& row) {
        if (found) found(lineOf(row));
    };

    const auto device = renderer.deviceInfo();
    Verification verification{"Pellucid " PELLUCID_VERSION,
                              fmt::format("{}, {}, {}", device.vendor, device.renderer, device.version)};
    for (const OrderPart& part : orderParts) {
        if (!part.wanted) continue;
        auto rows = part.run(renderer, parts.next(part.seconds), tell);
        if (!rows) return tl::unexpected(rows.error());
        auto& all = verification.orders ? *verification.orders : verification.orders.emplace();
        std::move(rows->begin(), rows->end(), std::back_inserter(all));
    }
    if (asked.extreme) {
        auto rows = verifyExtremes(renderer, parts.next(kExtremeSeconds), tell, asked.extremeNamed);
        if (!rows) return tl::unexpected(rows.error());
        verification.extremes = std::move(*rows);
    }
    return verification;
}

std::string verificationText(const Verification& verification) {
    std::string text = fmt::format("{}; {}\n", verification.program, verification.driver);
    if (verification.orders) text += "\n" + orderText(*verification.orders);
    if (verification.extremes) text += "\n" + extremeText(*verification.extremes);
    return text;
}

nlohmann::ordered_json verificationJson(const Verification& verification) {
    nlohmann::ordered_json json{{"program", verification.program},
                                {"driver", verification.driver},
                                {"passed", verification.passed()}};
    if (verification.orders) json["orders"] = orderJson(*verification.orders);
    if (verification.extremes) json["extreme"] = extremeJson(*verification.extremes);
    return json;
}

}  // namespace pellucid::accuracy
