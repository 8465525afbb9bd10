// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/json_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "scene/utf8.h"

namespace pellucid {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxTokenBytes = 60;

/// `offset`: bytes before the one that is wrong.
Error notJson(std::string_view text, std::size_t offset, std::string_view what) {
    const std::string_view read = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(read.begin(), read.end(), '\n') + 1;
    const std::string_view lastLine = read.substr(read.find_last_of('\n') + 1);  // npos + 1 is 0.
    const auto column =
        std::count_if(lastLine.begin(), lastLine.end(), [](char c) { return (c & 0xC0) != 0x80; }) + 1;
    return {ErrorCode::Corrupt, fmt::format("not JSON at line {}, column {}: {}", line, column, what), {}};
}

/// Builds a value from parser events, which is where repeated members and depth can still be seen.
class Builder : public nlohmann::json_sax<json> {
public:
    explicit Builder(std::string_view text) : m_text(text) {}

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& value) override { return add(std::move(value)); }
    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        m_key = std::move(name);
        if (!m_open.back()->contains(m_key)) return true;
        m_error = Error{ErrorCode::InvalidArgument,
                        fmt::format("{}: found twice, allowed is once", jsonPointer(pointer(), m_key)),
                        {}};
        return false;
    }

    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& exception) override {
        // The library's sentence repeats the place and its own error number before the part worth reading.
        std::string_view what(exception.what());
        if (const auto start = what.find("syntax error"); start != what.npos)
            what.remove_prefix(start);
        else if (const auto bracket = what.find("] "); bracket != what.npos)
            what.remove_prefix(bracket + 2);
        std::string shown(what);
        if (!isUtf8(shown))
            std::replace_if(
                shown.begin(), shown.end(), [](char c) { return (c & 0x80) != 0; }, '?');
        m_error = notJson(m_text, position > 0 ? position - 1 : 0, shown);
        return false;
    }

    Result<json> result(bool finished) {
        if (finished && !m_error) return std::move(m_root);
        return tl::unexpected(m_error.value_or(Error{ErrorCode::Corrupt, "not JSON", {}}));
    }

private:
    json* place(json&& value) {
        if (m_open.empty()) {
            m_root = std::move(value);
            return &m_root;
        }
        json& parent = *m_open.back();
        if (parent.is_object()) return &(parent[m_key] = std::move(value));
        parent.push_back(std::move(value));
        return &parent.back();
    }
    bool add(json value) {
        place(std::move(value));
        return true;
    }
    bool open(json value) {
        if (m_open.size() >= kMaxDepth) {
            m_error = Error{ErrorCode::InvalidArgument,
                            fmt::format("{}: found nesting deeper than {} levels", pointer(), kMaxDepth),
                            {}};
            return false;
        }
        // Containers in m_open never move: a parent gets no second child before the first is closed.
        json* const placed = place(std::move(value));
        m_tokens.push_back(m_key);
        m_open.push_back(placed);
        return true;
    }
    bool close() {
        m_open.pop_back();
        m_tokens.pop_back();
        return true;
    }
    /// Of the innermost open container.
    std::string pointer() const {
        std::string text;
        for (std::size_t i = 1; i < m_open.size(); ++i) {
            const json& parent = *m_open[i - 1];
            text = jsonPointer(text, parent.is_object() ? m_tokens[i] : std::to_string(parent.size() - 1));
        }
        return text;
    }

    std::string_view m_text;
    json m_root;
    std::vector<json*> m_open;
    std::vector<std::string> m_tokens;  ///< The member name under which each open container lies.
    std::string m_key;
    std::optional<Error> m_error;
};

}  // namespace

Result<json> parseJson(std::string_view text) {
    Builder builder(text);
    const bool finished = json::sax_parse(text.begin(), text.end(), &builder);
    Result<json> result = builder.result(finished);
    // The library takes a zero byte for the end of the text; what follows it would be dropped silently.
    const std::size_t zero = text.find('\0');
    if (result && zero != text.npos) return tl::unexpected(notJson(text, zero, "a zero byte"));
    return result;
}

std::string jsonPointer(std::string_view pointer, std::string_view token) {
    std::string text = fmt::format("{}/", pointer);
    std::size_t length = std::min(token.size(), kMaxTokenBytes);
    while (length < token.size() && length > 0 && !isUtf8(token.substr(0, length))) --length;
    for (const char c : token.substr(0, length)) {
        if (c == '~')
            text += "~0";
        else if (c == '/')
            text += "~1";
        else
            text += c;
    }
    if (length < token.size()) text += "...";
    return text;
}

}  // namespace pellucid
