// Reads the trees of a damaged session page by page, and says what is missing.
#include "core/session/session_rescue.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/session/session_schema.hpp"
#include "core/session/tile_code.hpp"
#include "core/sqlite/database_pages.hpp"

namespace dibhr {

namespace {

/// A tree of the file.
struct Tree {
    std::string name{};
    std::uint32_t root{0};
    bool index{false};      ///< of an index, or a table WITHOUT ROWID
    int number_column{-1};  ///< the one that is the rowid; -1: none
    std::vector<std::string> types{};
    std::optional<Statement> insert{};  ///< nothing: of an index, which is read as no table
};

bool fits(const StoredValue& value, const std::string& type) {
    if (type.empty() || std::holds_alternative<std::monostate>(value)) return true;
    if (type == "INTEGER") return std::holds_alternative<std::int64_t>(value);
    if (type == "TEXT") return std::holds_alternative<std::string>(value);
    if (type == "BLOB") return std::holds_alternative<StoredBytes>(value);
    return std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
}

void bind(Statement& row, const StoredValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        row.bind(*integer);
    else if (const auto* real = std::get_if<double>(&value))
        row.bind(SqlReal{*real});
    else if (const auto* text = std::get_if<std::string>(&value))
        row.bind(std::string_view(*text));
    else if (const auto* bytes = std::get_if<StoredBytes>(&value))
        row.bind(SqlBytes{bytes->value});
    else
        row.bind(std::optional<std::int64_t>());
}

class Rescue {
  public:
    Rescue(const std::filesystem::path& file, bool with_log, const Database::ErrorHandler& refuse)
        : pages_(file, with_log, kSessionPageBytes, kLongestSessionValue_bytes),
          owned_(std::max<std::size_t>(std::size_t{pages_.count()} + 1, 2)) {
        rescued_.database =
            std::make_unique<Database>(Database::Scratch{file, kLongestSessionValue_bytes}, refuse);
    }

    RescuedTables run() {
        const Database& database = *rescued_.database;
        database.execute("BEGIN");
        make_tables();
        for (Tree& tree : trees_) read(tree);
        if (pages_.lacks_frames())
            for (const Tree& tree : trees_) rescued_.incomplete.insert(tree.name);
        adopt_lost_leaves();
        trees_.clear();
        if (lacks({"surface", "grid", "grid_tile", "tile", "bump_map"})) drop_half_surfaces();
        database.execute("COMMIT");
        return std::move(rescued_);
    }

  private:
    [[nodiscard]] bool lacks(std::initializer_list<const char*> tables) const {
        return std::ranges::any_of(
            tables, [&](const char* name) { return rescued_.incomplete.contains(name); });
    }

    /// Rows of the file's table of tables; of this schema's where it cannot be read.
    [[nodiscard]] std::vector<StoredRow> table_rows() {
        Tree master{.name = "sqlite_master", .root = 1};
        std::vector<StoredRow> rows;
        walk(master, [&rows](StoredPage& page) {
            constexpr std::size_t kMostRows = 500;
            for (StoredRow& row : page.rows)
                if (row.values.size() == 5 && rows.size() < kMostRows)
                    rows.push_back(std::move(row));
            return true;
        });
        if (!rows.empty()) return rows;
        rescued_.incomplete.insert("sqlite_master");
        return rows_of_this_schema();
    }

    [[nodiscard]] static std::vector<StoredRow> rows_of_this_schema() {
        std::vector<StoredRow> rows;
        const Database here(":memory:");
        here.execute("PRAGMA page_size = " + std::to_string(kSessionPageBytes));
        here.execute(session_schema());
        for (Statement row(here, "SELECT type, name, rootpage, sql FROM sqlite_master");
             row.next();)
            rows.push_back({0, {row.text(0), row.text(1), {}, row.integer(2), row.text(3)}});
        return rows;
    }

    void make_tables() {
        const Database& database = *rescued_.database;
        for (const StoredRow& row : table_rows()) {
            const auto* type = std::get_if<std::string>(&row.values[0]);
            const auto* name = std::get_if<std::string>(&row.values[1]);
            const auto* root = std::get_if<std::int64_t>(&row.values[3]);
            const auto* sql = std::get_if<std::string>(&row.values[4]);
            if (type == nullptr || name == nullptr || root == nullptr) continue;
            const bool view = *type == "view" && *name == "tick";
            const bool table = *type == "table" && *root > 0 && !name->starts_with("sqlite_");
            const bool made = (view || table) && make(*name, view, sql == nullptr ? "" : *sql);
            if (*root > 0)
                trees_.push_back({.name = *name, .root = static_cast<std::uint32_t>(*root)});
            if (table && made) describe(trees_.back());
        }
        for (const auto& [name, at, known] :
             {std::tuple("user_version", 60, kSessionSchemaVersion),
              std::tuple("application_id", 68, kSessionApplicationId)}) {
            const auto number = pages_.head_number(static_cast<std::size_t>(at));
            database.execute(std::string("PRAGMA ") + name + " = " +
                             std::to_string(number.value_or(static_cast<std::uint32_t>(known))));
        }
    }

    /// By its own statement, or, where that is damaged, by this schema's; false: by none.
    bool make(const std::string& name, bool view, const std::string& sql) {
        if (make_by(sql, name, view)) return true;
        rescued_.incomplete.insert(name);
        return std::ranges::any_of(rows_of_this_schema(), [&](const StoredRow& row) {
            return std::get<std::string>(row.values[1]) == name &&
                   make_by(std::get<std::string>(row.values[4]), name, view);
        });
    }

    bool make_by(const std::string& sql, const std::string& name, bool view) const try {
        // An untrusted statement: nothing but this may be run, and no query fill a table.
        const std::string begin = view ? "CREATE VIEW tick AS " : "CREATE TABLE " + name;
        if (!sql.starts_with(begin)) return false;
        const std::size_t next = sql.find_first_not_of(" \n", begin.size());
        if (next == std::string::npos || (!view && sql[next] != '(')) return false;
        static_cast<void>(Statement(*rescued_.database, sql).next());
        return true;
    } catch (const DatabaseError& error) {
        if (error.cause() == DatabaseError::Cause::disk) throw;
        return false;
    }

    /// Columns by the table that was made.
    void describe(Tree& tree) const {
        const Database& database = *rescued_.database;
        const std::string in_quotes = "'" + replaced(tree.name, "'", "''") + "'";
        int keys = 0;
        std::string marks;
        for (Statement column(database, "SELECT type, pk FROM pragma_table_info(" + in_quotes +
                                            ") ORDER BY cid");
             column.next();) {
            const bool key = column.integer(1) > 0;
            if (key) ++keys;
            if (key && column.text(0) == "INTEGER")
                tree.number_column = static_cast<int>(tree.types.size());
            tree.types.push_back(column.text(0));
            marks += marks.empty() ? "?" : ", ?";
        }
        tree.index = database.number("SELECT count(*) FROM pragma_table_list(" + in_quotes +
                                     ") WHERE wr") > 0;
        if (keys != 1 || tree.index) tree.number_column = -1;
        if (!tree.types.empty())
            tree.insert.emplace(database, "INSERT OR IGNORE INTO \"" +
                                              replaced(tree.name, "\"", "\"\"") + "\" VALUES (" +
                                              marks + ")");
    }

    static std::string replaced(std::string text, std::string_view one, std::string_view two) {
        for (std::size_t at = text.find(one); at != std::string::npos;
             at = text.find(one, at + two.size()))
            text.replace(at, one.size(), two);
        return text;
    }

    /// Calls visit(page) for each page of the tree that can be read; false: it is of another one.
    template <typename Visit>
    void walk(const Tree& tree, Visit&& visit) {
        std::vector<std::uint32_t> next;
        const auto add = [&](std::uint32_t number) {
            if (number == 0 || number >= owned_.size() || owned_[number]) return false;
            owned_[number] = true;
            next.push_back(number);
            return true;
        };
        bool complete = add(tree.root);
        while (!next.empty()) {
            std::optional<StoredPage> page = read_page(next.back());
            next.pop_back();
            const bool read = page && visit(*page);
            complete = complete && read && !page->older;
            if (!read) continue;
            for (auto child = page->children.rbegin(); child != page->children.rend(); ++child)
                complete = add(*child) && complete;
        }
        if (!complete) rescued_.incomplete.insert(tree.name);
    }

    [[nodiscard]] std::optional<StoredPage> read_page(std::size_t number) {
        std::optional<StoredPage> page = pages_.page(static_cast<std::uint32_t>(number));
        any_page_ = any_page_ || page;
        return page;
    }

    void read(Tree& tree) {
        walk(tree, [&](StoredPage& page) { return !tree.insert || add(page, tree); });
    }

    /// False: the page holds something else than the table's rows.
    bool add(const StoredPage& page, Tree& tree) {
        if (!are_rows_of(page, tree)) return false;
        for (const StoredRow& row : page.rows) {
            for (std::size_t k = 0; k < row.values.size(); ++k) {
                if (std::cmp_equal(k, tree.number_column))
                    tree.insert->bind(row.number);
                else
                    bind(*tree.insert, row.values[k]);
            }
            tree.insert->run();
        }
        return true;
    }

    [[nodiscard]] bool are_rows_of(const StoredPage& page, const Tree& tree) {
        if (page.index != tree.index) return false;
        return std::ranges::all_of(page.rows, [&](const StoredRow& row) {
            return row.values.size() == tree.types.size() &&
                   std::ranges::equal(row.values, tree.types, fits) &&
                   (tree.name != "tile" || is_tile(row.values.back()));
        });
    }

    [[nodiscard]] bool is_tile(const StoredValue& value) {
        const auto* const bytes = std::get_if<StoredBytes>(&value);
        if (bytes == nullptr) return false;
        const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes->value.data());
        return unpacker_.unpack({first, bytes->value.size()}).has_value();
    }

    /// Leaves whose branches are lost are of the one damaged table that has such rows.
    void adopt_lost_leaves() {
        constexpr std::size_t kMostWithoutAny = 400;  // then it is no database
        for (std::size_t number = 2; !rescued_.incomplete.empty() && number < owned_.size();
             ++number) {
            if (owned_[number]) continue;
            if (!any_page_ && number > kMostWithoutAny) return;
            const std::optional<StoredPage> page = read_page(number);
            if (!page || !page->children.empty() || page->rows.empty()) continue;
            Tree* only = nullptr;
            bool several = false;
            for (Tree& tree : trees_) {
                if (!tree.insert || !rescued_.incomplete.contains(tree.name) ||
                    !are_rows_of(*page, tree))
                    continue;
                several = only != nullptr;
                only = &tree;
            }
            if (only != nullptr && !several) add(*page, *only);
        }
    }

    /// A missing tile is known to be missing; what follows would not be missed.
    void drop_half_surfaces() const {
        constexpr std::array<std::string_view, 5> kTables{"surface", "grid", "grid_tile", "tile",
                                                          "bump_map"};
        const Database& database = *rescued_.database;
        for (const std::string_view table : kTables)
            if (database.number("SELECT count(*) FROM sqlite_master WHERE name = '" +
                                std::string(table) + "'") == 0)
                return;
        // Parts before or after the ones that are there.
        if (lacks({"surface"}))
            database.execute(
                "DELETE FROM surface WHERE pair NOT IN (SELECT pair FROM surface WHERE part = 0)"
                " OR pair + 1 NOT IN (SELECT pair FROM surface)");
        database.execute(
            "DELETE FROM grid_tile WHERE tile NOT IN (SELECT id FROM tile);"
            "DELETE FROM surface WHERE pair IN (SELECT pair FROM surface WHERE"
            " levels NOT IN (SELECT id FROM grid) OR unseen NOT IN (SELECT id FROM grid)"
            " OR right NOT IN (SELECT id FROM grid) OR down NOT IN (SELECT id FROM grid));"
            "DELETE FROM bump_map WHERE (SELECT ((columns + 15) / 16) * ((rows + 15) / 16)"
            " FROM grid WHERE id = bump_map.grid) IS NOT"
            " (SELECT count(*) FROM grid_tile WHERE grid = bump_map.grid)");
        // Where one of two is not stored, the other is not used either.
        for (const auto& [one, other] : {std::pair("levels", "unseen"), std::pair("right", "down")})
            database.execute(
                std::string("DELETE FROM grid_tile WHERE (grid, place) IN (SELECT t.grid, t.place "
                            "FROM surface s JOIN grid_tile t ON t.grid = s.") +
                one + " LEFT JOIN grid_tile o ON o.grid = s." + other +
                " AND o.place = t.place WHERE s." + other + " IS NOT NULL AND o.place IS NULL)");
    }

    DatabasePages pages_;
    std::vector<bool> owned_;  ///< pages that a tree led to
    bool any_page_{false};     ///< was whole
    RescuedTables rescued_{};
    std::vector<Tree> trees_{};
    TileUnpacker unpacker_{};
};

/// What is lost of the ticks.
class TickLoss {
  public:
    TickLoss(const Database& database, bool incomplete) : database_(database) {
        rows_ = number_of("SELECT count(*) FROM tick_data").value_or(0);
        first_ = number_of("SELECT min(tick) FROM tick_data").value_or(0);
        last_ = number_of("SELECT max(tick) FROM tick_data").value_or(-1);
        dropped_ =
            std::max<std::int64_t>(number_of("SELECT max(dropped) FROM clock").value_or(0), 0);
        in_gaps_ = last_ - first_ + 1 - rows_ - dropped_;
        if (number_of("SELECT value FROM session WHERE key = 'complete'").value_or(0) != 0)
            recorded_ = number_of("SELECT value FROM session WHERE key = 'row_count'");
        if (const auto first = number_of("SELECT min(first_tick) FROM parameters"))
            at_begin_ = std::max<std::int64_t>(first_ - *first, 0);
        if (recorded_)
            at_end_ = *recorded_ - rows_ - in_gaps_ - at_begin_ > 0;
        else
            at_end_ = incomplete && in_gaps_ <= 0 && at_begin_ == 0;
    }

    [[nodiscard]] std::string text() const {
        const std::string places = this->places();
        const std::int64_t lost =
            recorded_ ? *recorded_ - rows_ : std::max<std::int64_t>(in_gaps_, 0) + at_begin_;
        if (lost <= 0 && !at_end_) return "no tick is lost";
        const std::string of = recorded_ ? " of " + std::to_string(*recorded_) : "";
        return (lost > 0 ? std::to_string(lost) + of + " ticks" : "ticks") + " cannot be read" +
               (places.empty() ? "" : " (" + places + ")");
    }

  private:
    /// "the first 20, from 3.2 s to 3.4 s, from 5.1 s on".
    [[nodiscard]] std::string places() const {
        constexpr int kMostNamed = 3;
        std::string text;
        const auto add = [&text](const std::string& place) {
            text += (text.empty() ? "" : ", ") + place;
        };
        if (at_begin_ > 0) add("the first " + std::to_string(at_begin_));
        Statement gaps(database_,
                       "SELECT tick, (SELECT min(tick) FROM tick_data WHERE tick > d.tick) "
                       "FROM tick_data d WHERE tick < " +
                           std::to_string(last_) +
                           " AND NOT EXISTS (SELECT 1 FROM tick_data WHERE tick = d.tick + 1)"
                           " ORDER BY tick");
        for (int k = 0; in_gaps_ > 0 && gaps.next(); ++k) {
            if (k == kMostNamed) {
                add("and in more places");
                break;
            }
            add("from " + time_of(gaps.integer(0)) + " to " + time_of(gaps.integer(1)));
        }
        if (at_end_) add("from " + time_of(last_) + " on");
        // Which ones, no table says.
        if (in_gaps_ > 0 && dropped_ > 0)
            text += "; " + std::to_string(dropped_) + " more there were never recorded";
        return text;
    }

    /// From the first tick that can be read on.
    [[nodiscard]] std::string time_of(std::int64_t tick) const {
        Statement row(database_,
                      "SELECT t - (SELECT t FROM tick WHERE tick = " + std::to_string(first_) +
                          ") FROM tick WHERE tick = " + std::to_string(tick));
        return number_text(row.next() ? row.real(0) : 0.0, 3) + " s";
    }

    /// Nothing: NULL or no row. Limited, so that no sum of some overflows.
    [[nodiscard]] std::optional<std::int64_t> number_of(const char* sql) const {
        constexpr std::int64_t kMost = std::int64_t{1} << 53U;
        Statement row(database_, sql);
        if (!row.next() || !row.has(0)) return std::nullopt;
        return std::clamp(row.integer(0), -kMost, kMost);
    }

    const Database& database_;
    std::int64_t rows_{0}, first_{0}, last_{-1};
    std::int64_t dropped_{0};  ///< by the recorder, whose ring was full
    std::int64_t in_gaps_{0}, at_begin_{0};
    bool at_end_{false};
    std::optional<std::int64_t> recorded_{};
};

/// "; not all can be read of its settings and surface"; empty: nothing else is lost.
std::string other_losses(const std::set<std::string>& incomplete) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kNames{{
        {"session", "facts"},
        {"parameters", "settings"},
        {"source", "sources"},
        {"pair", "frames' times"},
        {"media", "files"},
        {"mark", "marks"},
        {"clock", "wall clock"},
        {"touch_map", "touch maps"},
        {"surface", "surface"},
        {"grid", "surface"},
        {"grid_tile", "surface"},
        {"tile", "surface"},
        {"bump_map", "surface"},
        {"preview", "pictures"},
        {"sqlite_master", "tables"},
    }};
    std::vector<std::string_view> lost;
    for (const auto& [table, name] : kNames)
        if (incomplete.contains(std::string(table)) && std::ranges::find(lost, name) == lost.end())
            lost.push_back(name);
    constexpr std::size_t kMostNamed = 4;
    if (lost.empty()) return {};
    if (lost.size() > kMostNamed) return "; its other tables may lack rows, too";
    std::string text = "; not all can be read of its ";
    for (std::size_t k = 0; k < lost.size(); ++k)
        text.append(k == 0 ? "" : k + 1 == lost.size() ? " and " : ", ").append(lost[k]);
    return text;
}

}  // namespace

RescuedTables rescued_tables(const std::filesystem::path& file, bool with_log,
                             const Database::ErrorHandler& refuse) {
    return Rescue(file, with_log, refuse).run();
}

std::string loss_text(const Database& database, const std::set<std::string>& incomplete) {
    return TickLoss(database, incomplete.contains("tick_data")).text() + other_losses(incomplete);
}

}  // namespace dibhr
