// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "io/nrrd_header.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

constexpr int kMaxAxes = 16;  // NRRD_DIM_MAX
constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

/// One vector of "space directions" or "space origin": "(1,0,0)", or nothing for "none".
struct SpaceVector {
    bool none = false;
    std::vector<double> values;
};

Result<std::vector<SpaceVector>> vectorsFrom(std::string_view text, std::string_view field) {
    const auto bad = [&](std::string_view found) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("'{}': found '{}', allowed are vectors like (1,0,0) and none", field, shown(found)));
    };
    std::vector<SpaceVector> result;
    while (!(text = trimmed(text)).empty()) {
        if (lowered(text.substr(0, 4)) == "none") {
            result.push_back({true, {}});
            text.remove_prefix(4);
            continue;
        }
        const std::size_t close = text.find(')');
        if (text.front() != '(' || close == std::string_view::npos) return bad(text);
        std::string_view inside = text.substr(1, close - 1);
        text.remove_prefix(close + 1);
        SpaceVector vector;
        for (bool more = true; more;) {
            const std::size_t comma = std::min(inside.find(','), inside.size());
            const auto number = numberFrom<double>(trimmed(inside.substr(0, comma)));
            if (!number) return bad(inside);
            vector.values.push_back(*number);
            more = comma < inside.size();
            inside.remove_prefix(more ? comma + 1 : comma);
        }
        result.push_back(std::move(vector));
        if (result.size() > kMaxAxes) return bad("more vectors than there can be axes");
    }
    return result;
}

/// Factor from a length unit to mm.
std::optional<double> millimetresFrom(std::string_view unit) {
    const std::string low = lowered(trimmed(unit));
    if (low == "mm" || low == "millimeter" || low == "millimeters" || low == "millimetre") return 1.0;
    if (low == "cm" || low == "centimeter" || low == "centimeters") return 10.0;
    if (low == "m" || low == "meter" || low == "meters") return 1000.0;
    if (low == "um" || low == "micron" || low == "microns" || low == "micrometer" || low == "micrometers")
        return 1e-3;
    if (low == "nm" || low == "nanometer" || low == "nanometers") return 1e-6;
    return std::nullopt;
}

/// The quoted strings of "space units" or "units".
std::vector<std::string_view> quoted(std::string_view text) {
    std::vector<std::string_view> result;
    for (std::size_t open; (open = text.find('"')) != std::string_view::npos;) {
        const std::size_t close = text.find('"', open + 1);
        if (close == std::string_view::npos) break;
        result.push_back(text.substr(open + 1, close - open - 1));
        text.remove_prefix(close + 1);
    }
    return result;
}

/// Length units per space axis; silent for absent and empty ones (NRRD data in mm usually states none).
Result<glm::dvec3> unitFactors(std::string_view text, const std::vector<int>& which,
                               std::vector<Warning>& warnings) {
    glm::dvec3 factors(1.0);
    const std::vector<std::string_view> units = quoted(text);
    for (std::size_t axis = 0; axis < which.size() && axis < 3; ++axis) {
        const auto index = static_cast<std::size_t>(which[axis]);
        if (index >= units.size() || units[index].empty()) continue;
        const auto factor = millimetresFrom(units[index]);
        if (factor) {
            factors[static_cast<int>(axis)] = *factor;
        } else {
            warnings.push_back(
                {fmt::format("the length unit '{}' is not known; taken as mm", shown(units[index]))});
        }
    }
    return factors;
}

/// Numbers, one for each axis of the file; NaN where the file says so.
Result<std::vector<double>> perAxis(const NrrdHeader& header, const std::string& field, std::size_t axes) {
    std::vector<double> values;
    for (const std::string_view word : words(header.field(field))) {
        const auto number = numberFrom<double>(word);
        if (!number)
            return fail(ErrorCode::Corrupt, fmt::format("'{}': '{}' is not a number", field, shown(word)));
        values.push_back(*number);
    }
    if (!values.empty() && values.size() != axes) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("'{}' has {} numbers for {} axes", field, values.size(), axes));
    }
    return values;
}

/// Sign of each space axis on the way to LPS, or nothing when the space is not that of a patient.
std::optional<glm::dvec3> lpsFromSpace(std::string_view space) {
    const std::string low = lowered(space);
    if (low == "left-posterior-superior" || low == "lps") return glm::dvec3(1, 1, 1);
    if (low == "right-anterior-superior" || low == "ras") return glm::dvec3(-1, -1, 1);
    if (low == "left-anterior-superior" || low == "las") return glm::dvec3(1, -1, 1);
    return std::nullopt;
}

Result<void> placeByDirections(const NrrdHeader& header, const NrrdAxes& axes, Grid& grid,
                               std::vector<Warning>& warnings) {
    const auto directions = vectorsFrom(header.field("space directions"), "space directions");
    if (!directions) return tl::unexpected(directions.error());
    if (directions->size() != axes.sizes.size()) {
        return fail(ErrorCode::Corrupt, fmt::format("'space directions' has {} vectors for {} axes",
                                                    directions->size(), axes.sizes.size()));
    }
    const auto signs = lpsFromSpace(header.field("space"));
    if (!signs) {
        warnings.push_back({fmt::format(
            "the NRRD space is '{}': it states no patient orientation, taken as left-posterior-superior",
            shown(header.field("space")))});
    }
    const auto units = unitFactors(header.field("space units"), {0, 1, 2}, warnings);
    if (!units) return tl::unexpected(units.error());
    const glm::dvec3 toLps = signs.value_or(glm::dvec3(1.0)) * *units;
    const auto column = [&](const SpaceVector& vector) -> Result<glm::dvec3> {
        if (vector.values.size() != 3) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("a space of {} dimensions; 3 are drawn", vector.values.size()));
        }
        return glm::dvec3(vector.values[0], vector.values[1], vector.values[2]) * toLps;
    };
    for (std::size_t a = 0; a < axes.space.size(); ++a) {
        const auto direction = column((*directions)[static_cast<std::size_t>(axes.space[a])]);
        if (!direction) return tl::unexpected(direction.error());
        grid.patientFromIndex[static_cast<int>(a)] = glm::dvec4(*direction, 0.0);
    }
    if (axes.space.size() == 2) {
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(grid.patientFromIndex[0]), glm::dvec3(grid.patientFromIndex[1]));
        if (glm::length(normal) > 0.0) grid.patientFromIndex[2] = glm::dvec4(glm::normalize(normal), 0.0);
        warnings.push_back({"one slice without a thickness; taken as 1 mm"});
    }
    const auto origin = vectorsFrom(header.field("space origin"), "space origin");
    if (!origin) return tl::unexpected(origin.error());
    if (origin->empty()) {
        warnings.push_back({"the NRRD has no 'space origin'; the first voxel is taken to lie at 0, 0, 0"});
        return {};
    }
    const auto position = column(origin->front());
    if (!position) return tl::unexpected(position.error());
    grid.patientFromIndex[3] = glm::dvec4(*position, 1.0);
    return {};
}

/// 'spacings' (or 'axis mins' and 'axis maxs') only: no orientation.
Result<void> placeBySpacings(const NrrdHeader& header, const NrrdAxes& axes, Grid& grid,
                             std::vector<Warning>& warnings) {
    const auto spacings = perAxis(header, "spacings", axes.sizes.size());
    if (!spacings) return tl::unexpected(spacings.error());
    const auto mins = perAxis(header, "axis mins", axes.sizes.size());
    if (!mins) return tl::unexpected(mins.error());
    const auto maxs = perAxis(header, "axis maxs", axes.sizes.size());
    if (!maxs) return tl::unexpected(maxs.error());
    const auto units = unitFactors(header.field("units"), axes.space, warnings);
    if (!units) return tl::unexpected(units.error());
    const std::vector<std::string_view> centering = words(header.field("centerings"));
    for (std::size_t a = 0; a < axes.space.size(); ++a) {
        const auto axis = static_cast<std::size_t>(axes.space[a]);
        const bool cell = axis < centering.size() && lowered(centering[axis]) == "cell";
        const double min = mins->empty() ? kNotStated : (*mins)[axis];
        const double max = maxs->empty() ? kNotStated : (*maxs)[axis];
        double spacing = spacings->empty() ? kNotStated : (*spacings)[axis];
        if (std::isnan(spacing))
            spacing = (max - min) / (cell ? axes.sizes[axis] : std::max(axes.sizes[axis] - 1, 1));
        if (std::isnan(spacing)) {
            warnings.push_back({fmt::format("axis {} has no spacing; taken as 1 mm", axis)});
            spacing = 1.0;
        }
        const int i = static_cast<int>(a);
        grid.patientFromIndex[i] = glm::dvec4(0.0);
        grid.patientFromIndex[i][i] = spacing * (*units)[i];
        // The minimum of a cell-centred axis is the border of the first cell (section 5, "axis mins").
        if (!std::isnan(min))
            grid.patientFromIndex[3][i] = (min + (cell ? 0.5 * spacing : 0.0)) * (*units)[i];
    }
    warnings.push_back(
        {"the NRRD states no orientation; its axes are taken as left, posterior and superior"});
    return {};
}

}  // namespace

Result<NrrdAxes> nrrdAxes(const NrrdHeader& header) {
    NrrdAxes axes;
    const auto dimension = numberFrom<int>(header.field("dimension"));
    if (!dimension || *dimension < 1 || *dimension > kMaxAxes) {
        return fail(ErrorCode::Corrupt, fmt::format("'dimension' is '{}'; 1 to {} is allowed",
                                                    shown(header.field("dimension")), kMaxAxes));
    }
    for (const std::string_view word : words(header.field("sizes"))) {
        const auto size = numberFrom<int>(word);
        if (!size || *size < 1)
            return fail(ErrorCode::Corrupt,
                        fmt::format("'sizes': '{}' is not a positive integer", shown(word)));
        axes.sizes.push_back(*size);
    }
    if (axes.sizes.size() != static_cast<std::size_t>(*dimension)) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("'sizes' has {} numbers, 'dimension' is {}", axes.sizes.size(), *dimension));
    }
    const auto directions = vectorsFrom(header.field("space directions"), "space directions");
    if (!directions) return tl::unexpected(directions.error());
    const std::vector<std::string_view> kinds = words(header.field("kinds"));
    for (std::size_t axis = 0; axis < axes.sizes.size(); ++axis) {
        const std::string kind = axis < kinds.size() ? lowered(kinds[axis]) : std::string{};
        const bool placed = axis < directions->size() && !(*directions)[axis].none;
        const bool spatial = directions->empty() ? kind.empty() || kind == "domain" || kind == "space" ||
                                                       kind == "???" || kind == "none"
                                                 : placed;
        if (kind == "complex" || kind == "2d-complex")
            return fail(ErrorCode::Unsupported, "complex numbers are not drawn");
        if (kind == "time" || kind == "list") {
            if (axes.sizes[axis] == 1) continue;
            return fail(ErrorCode::Unsupported,
                        fmt::format("{}D, {} {}: not yet; save one of them as a volume", axes.sizes.size(),
                                    axes.sizes[axis], kind == "time" ? "time steps" : "volumes in a list"));
        }
        if (spatial) {
            axes.space.push_back(static_cast<int>(axis));
        } else if (axes.sizes[axis] > 1) {
            if (axes.componentAxis >= 0)
                return fail(ErrorCode::Unsupported, "two axes that are not of space; at most one is read");
            axes.componentAxis = static_cast<int>(axis);
            axes.components = axes.sizes[axis];
        }
    }
    if (axes.space.size() < 2 || axes.space.size() > 3) {
        return fail(ErrorCode::Unsupported, fmt::format("{} axes of space ({}); 2 or 3 are read",
                                                        axes.space.size(), header.field("sizes")));
    }
    if (axes.components > 4)
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} components a voxel; 1 to 4 are drawn", axes.components));
    if (axes.componentAxis > 0 && axes.componentAxis < axes.space.back()) {
        return fail(
            ErrorCode::Unsupported,
            "the axis of components lies between the axes of space; it must be the first or the last");
    }
    return axes;
}

Result<Grid> nrrdGrid(const NrrdHeader& header, const NrrdAxes& axes, std::vector<Warning>& warnings) {
    Grid grid;
    for (std::size_t a = 0; a < axes.space.size(); ++a)
        grid.size[static_cast<int>(a)] = axes.sizes[static_cast<std::size_t>(axes.space[a])];
    const bool placed = !header.field("space directions").empty();
    const auto done = placed ? placeByDirections(header, axes, grid, warnings)
                             : placeBySpacings(header, axes, grid, warnings);
    if (!done) return tl::unexpected(done.error());
    return grid;
}

}  // namespace pellucid::io
