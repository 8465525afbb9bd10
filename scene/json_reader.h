// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/names.h"
#include "scene/result.h"

namespace pellucid {

/// Keeps the first complaint of a document. Reading goes on after one, so that readers need no branches.
class JsonComplaints {
public:
    /// "POINTER: found FOUND, allowed is ALLOWED".
    void add(const std::string& pointer, std::string_view found, std::string_view allowed);
    [[nodiscard]] bool any() const { return m_first.has_value(); }
    [[nodiscard]] const std::optional<Error>& first() const { return m_first; }

private:
    std::optional<Error> m_first;
};

/// A value as an error message shows it: 200, "fast", an array of 3, an object. Never long.
[[nodiscard]] std::string foundText(const nlohmann::json& value);
/// `one of "a", "b" (did you mean "b"?)`; the guess only when a name is near to what was found.
[[nodiscard]] std::string oneOf(std::string_view found, const std::vector<std::string>& names);

/// Reads the members of one JSON object; whatever does not fit becomes a complaint and leaves the target as
/// it was. Members that are absent leave the target as it was too. Only types are judged here: limits of
/// numbers are the business of validate().
class JsonObject {
public:
    /// Complains unless `value` is an object that has no members but `members`.
    JsonObject(const nlohmann::json& value, std::string pointer, JsonComplaints& complaints,
               std::vector<std::string> members);

    /// The member, or null when it is absent. Precondition: listed in the constructor.
    [[nodiscard]] const nlohmann::json* find(const char* member) const;
    [[nodiscard]] std::string pointerTo(const char* member) const;
    [[nodiscard]] JsonComplaints& complaints() const { return *m_complaints; }

    /// Complains when the member is absent.
    void require(const char* member, std::string_view allowed) const;
    /// Complains when both are there.
    void exclude(const char* one, const char* other) const;

    void read(const char* member, double& target) const;
    void read(const char* member, int& target) const;
    void read(const char* member, bool& target) const;
    void read(const char* member, std::string& target) const;
    void read(const char* member, glm::dvec3& target) const;
    void read(const char* member, glm::ivec2& target) const;
    /// "#rrggbb" or three numbers.
    void readColor(const char* member, glm::dvec3& target) const;

    void read(const char* member, std::optional<double>& target) const {
        double value = 0.0;
        if (!find(member)) return;
        read(member, value);
        target = value;
    }

    template <class E>
    void readName(const char* member, E& target) const {
        std::vector<std::string> names;
        for (const auto& entry : enumNames<E>()) names.emplace_back(entry.name);
        std::string text;
        if (readNameText(member, names, text)) target = *enumFromName<E>(text);
    }

    /// Calls f(element, pointer) for each element of an array member; complains when it is something else.
    template <class F>
    void forEach(const char* member, F&& f) const {
        const nlohmann::json* array = find(member);
        if (!array) return;
        if (!array->is_array()) {
            m_complaints->add(pointerTo(member), foundText(*array), "an array");
            return;
        }
        std::size_t index = 0;
        for (const nlohmann::json& element : *array)
            f(element, pointerTo(member) + "/" + std::to_string(index++));
    }

private:
    bool readNameText(const char* member, const std::vector<std::string>& names, std::string& text) const;
    void readNumbers(const char* member, double* target, std::size_t count, std::string_view allowed) const;

    const nlohmann::json* m_value;  ///< Null when it is not an object.
    std::string m_pointer;
    JsonComplaints* m_complaints;
    std::vector<std::string> m_members;
};

}  // namespace pellucid
