// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>

#include "io/dicom_dataset.h"
#include "io/dicom_header.h"
#include "io/dicom_series.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

/// "DICM" after the preamble of 128 bytes (PS3.10 section 7.1).
bool hasDicomMark(const fs::path& file) {
    std::array<char, 132> head{};
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    std::ifstream stream(file, std::ios::binary);
    return stream.read(head.data(), head.size()) && std::string_view(head.data() + 128, 4) == "DICM";
}

/// The files of a scan and what happens to each on the way.
class Scanner {
public:
    explicit Scanner(const Progress& progress) : m_progress(progress) {}

    Result<DicomScan> scan(const std::vector<fs::path>& paths) {
        for (const fs::path& path : paths) {
            if (auto listed = list(path); !listed) return tl::unexpected(listed.error());
        }
        for (m_next = 0; m_next < m_files.size(); ++m_next) {
            const double done = static_cast<double>(m_next) / static_cast<double>(m_files.size());
            if (!goOn(m_progress, done, "reading DICOM headers"))
                return fail(ErrorCode::Cancelled, "the scan was cancelled");
            if (auto looked = look(m_files[m_next]); !looked) return tl::unexpected(looked.error());
        }
        if (m_scan.series.empty()) return nothing(paths);
        for (DicomSeries& series : m_scan.series) series.warnings = condensed();
        return std::move(m_scan);
    }

private:
    struct Entry {
        fs::path path;
        bool named = false;  ///< By the caller, not found in a folder.
    };

    Result<void> list(const fs::path& path) {
        std::error_code error;
        if (!fs::exists(path, error))
            return fail(ErrorCode::NotFound, fmt::format("{} does not exist", shown(path.string(), 200)));
        if (!fs::is_directory(path, error)) {
            add(path, true);
            return {};
        }
        std::vector<fs::path> found;
        fs::recursive_directory_iterator it(path, fs::directory_options::skip_permission_denied, error);
        for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
            std::error_code ignored;
            if (it->is_regular_file(ignored)) found.push_back(it->path());
        }
        if (error) {
            return fail(ErrorCode::Unreadable, fmt::format("the folder {} cannot be read: {}",
                                                           shown(path.string(), 200), error.message()));
        }
        std::sort(found.begin(), found.end());
        for (const fs::path& file : found) add(file, false);
        return {};
    }

    /// The same file by two ways (a folder and a DICOMDIR in it) counts once.
    void add(const fs::path& file, bool named) {
        std::error_code error;
        const fs::path canonical = fs::weakly_canonical(file, error);
        if (m_seen.insert(error ? file : canonical).second) m_files.push_back({file, named});
    }

    void leaveOut(const fs::path& file, std::string_view reason) {
        m_scan.leftOut.push_back({fmt::format("left out {}: {}", shown(file.filename().string()), reason)});
    }

    // By value: a DICOMDIR adds entries.
    Result<void> look(const Entry entry) {
        if (!looksLikeDicom(entry.path)) {
            leaveOut(entry.path, "not a DICOM file");
            return {};
        }
        const auto identity = identifyDicom(entry.path);
        if (!identity) return notReadable(entry, identity.error());
        if (identity->isDirectory) {
            // In a folder its files are found anyway.
            return entry.named ? expandDirectory(entry.path) : Result<void>{};
        }
        if (!identity->refusal.empty()) {
            leaveOut(entry.path, identity->refusal);
            return {};
        }
        // A damaged slice stays in its series, so that it is missed there; without a series it may belong to
        // any.
        if (!identity->damage.empty() && identity->seriesUid.empty()) {
            return notReadable(
                entry,
                {ErrorCode::Corrupt, shown(entry.path.filename().string()) + ": " + identity->damage, {}});
        }
        group(*identity);
        return {};
    }

    /// A damaged file may be a slice of any series here, so it stops the scan; what only resembles DICOM does
    /// not.
    Result<void> notReadable(const Entry& entry, const Error& error) {
        if (error.code == ErrorCode::Corrupt && hasDicomMark(entry.path)) {
            return fail(error.code,
                        error.message + (entry.named ? "" : "; move it out of the folder to load the rest"));
        }
        if (error.code != ErrorCode::Corrupt && error.code != ErrorCode::Unsupported)
            return tl::unexpected(error);
        m_scan.leftOut.push_back({"left out " + error.message});
        return {};
    }

    void group(const DicomIdentity& identity) {
        const auto same = [&](const std::pair<std::string, std::string>& key) {
            return key.first == identity.studyUid && key.second == identity.seriesUid;
        };
        const auto at = std::find_if(m_keys.begin(), m_keys.end(), same);
        const auto index = static_cast<std::size_t>(at - m_keys.begin());
        if (at == m_keys.end()) {
            m_keys.emplace_back(identity.studyUid, identity.seriesUid);
            m_scan.series.push_back({identity.seriesUid, identity.description, identity.modality, {}, {}});
        }
        m_scan.series[index].files.push_back(identity.file);
    }

    /// The files a DICOMDIR names, in any order of its records (PS3.10 section 8, PS3.3 annex F).
    Result<void> expandDirectory(const fs::path& file) {
        auto data = DicomDataset::open(file, DicomDataset::Part::Header);
        if (!data) return tl::unexpected(data.error());
        DcmSequenceOfItems* records = nullptr;
        if (data->dcmtk().findAndGetSequence(DCM_DirectoryRecordSequence, records).bad() ||
            records == nullptr)
            return {};
        for (unsigned long i = 0; i < records->card(); ++i) {
            OFString id;
            if (records->getItem(i)->findAndGetOFStringArray(DCM_ReferencedFileID, id).bad() || id.empty())
                continue;
            const auto named = fileOfId(file.parent_path(), std::string(id.c_str(), id.length()));
            if (named) {
                add(*named, true);
            } else {
                leaveOut(shown(id.c_str(), 200), "the DICOMDIR names it, and it is not there");
            }
        }
        return {};
    }

    /// A file ID has its components separated by backslashes. Media copied by some systems have them in lower
    /// case.
    static std::optional<fs::path> fileOfId(const fs::path& root, std::string_view id) {
        for (const bool lower : {false, true}) {
            fs::path path = root;
            std::string_view rest = id;
            while (true) {
                const std::size_t end = rest.find('\\');
                const std::string_view part = trimmed(rest.substr(0, end));
                // Never outside the medium.
                if (part.empty() || part == ".." || part == "." || part.find('/') != std::string_view::npos)
                    return std::nullopt;
                path /= lower ? lowered(part) : std::string(part);
                if (end == std::string_view::npos) break;
                rest.remove_prefix(end + 1);
            }
            std::error_code error;
            if (fs::is_regular_file(path, error)) return path;
        }
        return std::nullopt;
    }

    /// What a volume's warnings carry: each while they are few, otherwise a sum.
    [[nodiscard]] std::vector<Warning> condensed() const {
        constexpr std::size_t kMost = 8;
        std::vector<Warning> result(
            m_scan.leftOut.begin(),
            m_scan.leftOut.begin() + static_cast<std::ptrdiff_t>(std::min(kMost, m_scan.leftOut.size())));
        if (m_scan.leftOut.size() > kMost) {
            result.push_back({fmt::format("left out {} more files", m_scan.leftOut.size() - kMost)});
        }
        return result;
    }

    [[nodiscard]] tl::unexpected<Error> nothing(const std::vector<fs::path>& paths) const {
        std::string reasons;
        for (const Warning& warning : condensed())
            reasons += (reasons.empty() ? ": " : "; ") + warning.message;
        const std::string where = paths.empty() ? "no path" : shown(paths.front().string(), 200);
        return fail(
            ErrorCode::Unsupported,
            fmt::format("{}{}: no DICOM image a volume can be made of{}", where,
                        paths.size() > 1 ? fmt::format(" and {} more", paths.size() - 1) : "", reasons));
    }

    const Progress& m_progress;
    std::vector<Entry> m_files;
    std::set<fs::path> m_seen;
    std::size_t m_next = 0;
    DicomScan m_scan;
    std::vector<std::pair<std::string, std::string>> m_keys;  ///< Study and series UID of each series.
};

}  // namespace

bool looksLikeDicom(const std::filesystem::path& file) {
    if (hasDicomMark(file)) return true;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    // Without preamble: the first element is of group 0002 or 0008 and has a VR of letters or a short length.
    std::array<unsigned char, 8> head{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(head.data()), head.size())) return false;
    const bool little = (head[0] == 2 || head[0] == 8) && head[1] == 0 && head[3] == 0;
    const bool big = head[0] == 0 && head[1] == 8 && head[2] == 0;
    const auto letter = [](unsigned char c) { return c >= 'A' && c <= 'Z'; };
    if (!little && !big) return false;
    if (letter(head[4]) && letter(head[5])) return true;
    return little && head[0] == 8 && head[5] == 0 && head[6] == 0 && head[7] == 0 && head[4] % 2 == 0;
}

Result<DicomScan> scanDicom(const std::vector<std::filesystem::path>& paths, const Progress& progress) {
    return Scanner(progress).scan(paths);
}

Result<DicomSeries> chooseSeries(const DicomScan& scan, const std::string& uid) {
    std::string list;
    for (const DicomSeries& series : scan.series) {
        list += fmt::format("\n  {}  {} \"{}\", {} file{}", shown(series.uid, 64), shown(series.modality),
                            series.description, series.files.size(), series.files.size() == 1 ? "" : "s");
    }
    std::vector<const DicomSeries*> matching;
    for (const DicomSeries& series : scan.series) {
        if (uid.empty() || series.uid == uid) matching.push_back(&series);
    }
    if (matching.size() == 1) return *matching.front();
    if (matching.empty()) {
        return fail(ErrorCode::NotFound, fmt::format("no series has the UID {}; there {}:{}", shown(uid, 64),
                                                     scan.series.size() == 1 ? "is" : "are", list));
    }
    return fail(ErrorCode::Inconsistent,
                fmt::format("{} series, and a volume is made of one: choose it by its UID (--series UID):{}",
                            matching.size(), list));
}

}  // namespace pellucid::io
