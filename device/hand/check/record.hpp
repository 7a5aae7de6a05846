// The record of a check: one JSON file, written again after every step, with the answers to the
// questions that the README.md of the device leaves open.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/files/json.hpp"

namespace dibhr {

/// One open question.
struct CheckQuestion {
    const char* name;      ///< in the record
    const char* question;  ///< as printed
};

class CheckFindings {
  public:
    /// `questions` must outlive this object; `table`: of the settings file.
    CheckFindings(std::span<const CheckQuestion> questions, const char* table)
        : questions_(questions), table_(table), found_(questions.size()) {}

    /// `question`: of an enumeration in the order of the questions. A later answer replaces an
    /// earlier one.
    template <typename Question>
    void record_answer(Question question, std::string found) {
        found_.at(static_cast<std::size_t>(question)) = std::move(found);
    }
    /// Adds a line for the table of the settings file: `value` in TOML syntax.
    void set(const std::string& name, const std::string& value) { settings_[name] = value; }

    /// A text for the user: every question with its answer or "still open", and the settings.
    [[nodiscard]] std::string summary() const;
    /// Adds "findings" and "settings" to the record.
    void add_to(Json& record) const;

  private:
    std::span<const CheckQuestion> questions_;
    const char* table_;
    std::vector<std::string> found_;  // empty: still open
    Json settings_ = Json::object();
};

/// How a step ended.
enum class CheckEnd : std::size_t { done, skipped, released, quit, failed, not_begun };

struct CheckedDevice {
    std::string kind{};      ///< "falcon"
    std::string name_key{};  ///< JSON key of the name in the record: "serial"
    std::string name{};
};

class CheckRecord {
  public:
    /// `file` empty: KIND-check-NAME-DATE.json in the current folder.
    CheckRecord(std::filesystem::path file, const CheckedDevice& device,
                const std::vector<std::pair<std::string, std::string>>& facts);

    /// Adds these members to the head of the record.
    void add_to_head(const Json& members) { head_.update(members); }
    /// Sets the legend, the last member of the record: the meaning of every name.
    void set_legend(Json legend) { legend_ = std::move(legend); }
    /// `remark`: why it failed or was not begun.
    void add(const char* step, CheckEnd end, const std::string& remark, double seconds,
             const Json& measured);
    /// The whole file, or none of it. Throws InputError.
    void write(const CheckFindings& findings) const;

    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

  private:
    std::filesystem::path file_;
    Json head_{};
    Json steps_ = Json::array();
    Json legend_{};
};

}  // namespace dibhr
