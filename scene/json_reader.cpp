// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/check.h"
#include "scene/json_parse.h"
#include "scene/near_name.h"
#include "scene/utf8.h"

namespace pellucid {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxFoundBytes = 40;

std::string shortQuote(std::string_view text) {
    std::size_t length = std::min(text.size(), kMaxFoundBytes);
    while (length > 0 && length < text.size() && !isUtf8(text.substr(0, length))) --length;
    const std::string shown =
        json(std::string(text.substr(0, length))).dump(-1, ' ', false, json::error_handler_t::replace);
    return length < text.size() ? shown + "..." : shown;
}

bool isIntegerIn32Bits(const json& value) {
    if (value.is_number_unsigned()) return std::in_range<int>(value.get<std::uint64_t>());
    if (value.is_number_integer()) return std::in_range<int>(value.get<std::int64_t>());
    if (!value.is_number_float()) return false;
    const auto number = value.get<double>();
    return number == std::floor(number) && number >= std::numeric_limits<int>::min() &&
           number <= std::numeric_limits<int>::max();
}

bool isFiniteNumber(const json& value) {
    return value.is_number() && std::isfinite(value.get<double>());
}

/// One hexadecimal digit, or nothing.
std::optional<int> hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return std::nullopt;
}

std::optional<glm::dvec3> colorFromHex(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    glm::dvec3 color{0.0};
    for (int c = 0; c < 3; ++c) {
        const auto high = hexDigit(text[static_cast<std::size_t>(1 + 2 * c)]);
        const auto low = hexDigit(text[static_cast<std::size_t>(2 + 2 * c)]);
        if (!high || !low) return std::nullopt;
        color[c] = (*high * 16 + *low) / 255.0;
    }
    return color;
}

}  // namespace

void JsonComplaints::add(const std::string& pointer, std::string_view found, std::string_view allowed) {
    if (m_first) return;
    m_first =
        Error{ErrorCode::InvalidArgument,
              fmt::format("{}: found {}, allowed is {}", pointer.empty() ? "/" : pointer, found, allowed),
              {}};
}

std::string foundText(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    if (value.is_string()) return shortQuote(value.get_ref<const std::string&>());
    if (value.is_number_float()) return fmt::format("{}", value.get<double>());
    return value.dump();
}

std::string oneOf(std::string_view found, const std::vector<std::string>& names) {
    std::string text = "one of ";
    for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("{}\"{}\"", i ? ", " : "", names[i]);
    if (const auto near = nearestName(found, names)) text += fmt::format(" (did you mean \"{}\"?)", *near);
    return text;
}

JsonObject::JsonObject(const json& value, std::string pointer, JsonComplaints& complaints,
                       std::vector<std::string> members)
    : m_value(value.is_object() ? &value : nullptr),
      m_pointer(std::move(pointer)),
      m_complaints(&complaints),
      m_members(std::move(members)) {
    if (!m_value) {
        complaints.add(m_pointer, foundText(value), "an object");
        return;
    }
    for (const auto& [key, member] : value.items())
        if (std::find(m_members.begin(), m_members.end(), key) == m_members.end())
            complaints.add(jsonPointer(m_pointer, key), "an unknown member", oneOf(key, m_members));
}

const json* JsonObject::find(const char* member) const {
    PELLUCID_CHECK(std::find(m_members.begin(), m_members.end(), member) != m_members.end());
    if (!m_value) return nullptr;
    const auto found = m_value->find(member);
    return found == m_value->end() ? nullptr : &*found;
}

std::string JsonObject::pointerTo(const char* member) const {
    return jsonPointer(m_pointer, member);
}

void JsonObject::require(const char* member, std::string_view allowed) const {
    if (m_value && !find(member)) m_complaints->add(pointerTo(member), "nothing", allowed);
}

void JsonObject::exclude(const char* one, const char* other) const {
    if (find(one) && find(other))
        m_complaints->add(pointerTo(other), fmt::format("beside \"{}\"", one), "one of the two");
}

void JsonObject::read(const char* member, double& target) const {
    const json* value = find(member);
    if (!value) return;
    if (!isFiniteNumber(*value))
        m_complaints->add(pointerTo(member), foundText(*value), "a finite number");
    else
        target = value->get<double>();
}

void JsonObject::read(const char* member, int& target) const {
    const json* value = find(member);
    if (!value) return;
    if (!isIntegerIn32Bits(*value))
        m_complaints->add(pointerTo(member), foundText(*value), "an integer of at most 32 bits");
    else
        target = value->get<int>();
}

void JsonObject::read(const char* member, bool& target) const {
    const json* value = find(member);
    if (!value) return;
    if (!value->is_boolean())
        m_complaints->add(pointerTo(member), foundText(*value), "true or false");
    else
        target = value->get<bool>();
}

void JsonObject::read(const char* member, std::string& target) const {
    const json* value = find(member);
    if (!value) return;
    if (!value->is_string())
        m_complaints->add(pointerTo(member), foundText(*value), "text in quotes");
    else
        target = value->get<std::string>();
}

void JsonObject::readNumbers(const char* member, double* target, std::size_t count,
                             std::string_view allowed) const {
    const json* value = find(member);
    if (!value) return;
    if (!value->is_array() || value->size() != count) {
        m_complaints->add(pointerTo(member), foundText(*value), allowed);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const json& element = (*value)[i];
        if (isFiniteNumber(element))
            target[i] = element.get<double>();
        else
            m_complaints->add(jsonPointer(pointerTo(member), std::to_string(i)), foundText(element),
                              "a finite number");
    }
}

void JsonObject::read(const char* member, glm::dvec3& target) const {
    readNumbers(member, &target.x, 3, "an array of 3 numbers");
}

void JsonObject::read(const char* member, glm::ivec2& target) const {
    const json* value = find(member);
    if (!value) return;
    if (!value->is_array() || value->size() != 2) {
        m_complaints->add(pointerTo(member), foundText(*value), "an array of 2 integers");
        return;
    }
    for (int i = 0; i < 2; ++i) {
        const json& element = (*value)[static_cast<std::size_t>(i)];
        if (isIntegerIn32Bits(element))
            target[i] = element.get<int>();
        else
            m_complaints->add(jsonPointer(pointerTo(member), std::to_string(i)), foundText(element),
                              "an integer of at most 32 bits");
    }
}

void JsonObject::readColor(const char* member, glm::dvec3& target) const {
    constexpr std::string_view kAllowed = "a colour: \"#rrggbb\" or an array of 3 numbers";
    const json* value = find(member);
    if (!value) return;
    if (!value->is_string()) {
        readNumbers(member, &target.x, 3, kAllowed);
        return;
    }
    if (const auto color = colorFromHex(value->get_ref<const std::string&>()))
        target = *color;
    else
        m_complaints->add(pointerTo(member), foundText(*value), kAllowed);
}

bool JsonObject::readNameText(const char* member, const std::vector<std::string>& names,
                              std::string& text) const {
    const json* value = find(member);
    if (!value) return false;
    if (value->is_string()) {
        text = value->get<std::string>();
        if (std::find(names.begin(), names.end(), text) != names.end()) return true;
    }
    m_complaints->add(pointerTo(member), foundText(*value), oneOf(text, names));
    return false;
}

}  // namespace pellucid
