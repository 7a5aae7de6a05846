// The manual page and the shells' completions.
#include "app/commands/documentation.hpp"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <sstream>

#include "app/settings/command_options.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/enum_names.hpp"

namespace dibhr {

namespace {

// How to change keys.
constexpr std::string_view kOwnKeys =
    "A table [keys] in ~/.config/dibhr/settings.toml gives actions other keys than the usual ones:";
constexpr std::string_view kOwnKeysExample =
    "  [keys]\n"
    "  play-or-pause = \"Space\"\n"
    "  record = [\"F7\", \"Ctrl+R\"]\n"
    "  toggle-sound = \"\"";
constexpr std::string_view kOwnKeysRules =
    "Write keys as in this list; \"\" means no key. A key that you give to one action is taken "
    "from the action that had it. F8 always takes the force off; force-off can have other keys as "
    "well.";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

std::vector<std::string> split(const std::string& text, std::string_view at) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(at, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + at.size();
    }
    return parts;
}

std::string without_parentheses(std::string text) {
    for (std::size_t open = 0; (open = text.find(" (")) != std::string::npos;) {
        const std::size_t close = text.find(')', open);
        if (close == std::string::npos) break;
        text.erase(open, close + 1 - open);
    }
    return text;
}

/// Escapes text for troff: backslashes, hyphens, and requests at the beginning of a line.
std::string troff(std::string text) {
    text = replaced(replaced(std::move(text), "\\", "\\e"), "-", "\\-");
    text = replaced(std::move(text), "\n.", "\n\\&.");
    text = replaced(std::move(text), "\n'", "\n\\&'");
    return text.starts_with('.') || text.starts_with('\'') ? "\\&" + text : text;
}

void add_option(std::ostringstream& page, const DocumentedOption& option) {
    const std::string shown = option.is_argument() ? option.argument : listed(option.names);
    page << ".TP\n\\fB" << troff(shown) << "\\fR";
    if (!option.type.empty()) page << " \\fI" << troff(option.type) << "\\fR";
    page << '\n' << troff(option.help);
    if (option.required) page << " (required)";
    if (!option.default_text.empty())
        page << " (" << troff(option.default_text) << " unless given)";
    page << '\n';
}

/// The table of keys, and how to change them.
void add_keys(std::ostringstream& page) {
    page << ".SH KEYS\n"
         << troff(std::string(kOwnKeys)) << "\n.PP\n.nf\n"
         << troff(std::string(kOwnKeysExample)) << "\n.fi\n.PP\n"
         << troff(std::string(kOwnKeysRules)) << '\n';
    const KeyTable keys;
    for (const KeyJob& job : key_jobs()) {
        page << ".TP\n\\fB" << troff(keys.names_for(job.action)) << "\\fR ("
             << troff(std::string(job.name)) << ")\n"
             << troff(std::string(job.help)) << '\n';
    }
}

void add_command(std::ostringstream& page, const DocumentedCommand& command) {
    page << ".SS dibhr " << troff(command.name) << ' ' << troff(command.arguments) << '\n'
         << troff(command.summary) << ".\n";
    for (const DocumentedOption& option : command.options) add_option(page, option);
    if (!command.examples.empty()) page << ".PP\n.nf\n" << troff(command.examples) << "\n.fi\n";
}

std::string names_of(const std::vector<DocumentedCommand>& commands) {
    std::vector<std::string> names = all_names(commands);
    names.insert(names.end(), {"help", "completion"});
    return listed(names, " ");
}

/// In single quotes of a shell.
std::string quoted(const std::string& text) {
    return "'" + replaced(text, "'", "'\\''") + "'";
}

/// Completes the value after an option, where it is no file.
void add_bash_values(std::ostringstream& script, const DocumentedCommand& command) {
    for (const DocumentedOption& option : command.options) {
        if (option.is_argument() || option.type.empty() || option.takes_file()) continue;
        const std::vector<std::string> values = option.values();
        script << "        " << command.name << ':' << option.names.front() << ") ";
        if (!values.empty())
            script << "COMPREPLY=($(compgen -W '" << listed(values, " ") << "' -- \"$cur\")); ";
        script << "return ;;\n";
    }
}

void add_bash_options(std::ostringstream& script, const DocumentedCommand& command) {
    script << "        " << command.name << ") options='";
    for (const DocumentedOption& option : command.options)
        if (!option.is_argument()) script << option.names.front() << ' ';
    script << "' ;;\n";
}

std::string bash_completion(const std::vector<DocumentedCommand>& commands) {
    std::ostringstream script;
    script
        << "# bash completion of dibhr\n"
           "_dibhr() {\n"
           "    local IFS=$' \\t\\n' cur=${COMP_WORDS[COMP_CWORD]} "
           "prev=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    local command=view options='' commands='"
        << names_of(commands)
        << "'\n"
           "    if ((COMP_CWORD > 1)) && [[ \" $commands \" == *\" ${COMP_WORDS[1]} \"* ]]; then\n"
           "        command=${COMP_WORDS[1]}\n"
           "    fi\n"
           "    COMPREPLY=()\n"
           "    case $command in\n"
           "        help) COMPREPLY=($(compgen -W \"$commands keys\" -- \"$cur\")); return ;;\n"
           "        completion) COMPREPLY=($(compgen -W 'bash zsh fish' -- \"$cur\")); return ;;\n"
           "    esac\n"
           "    case $command:$prev in\n";
    for (const DocumentedCommand& command : commands) add_bash_values(script, command);
    script << "    esac\n    case $command in\n";
    for (const DocumentedCommand& command : commands) add_bash_options(script, command);
    script
        << "    esac\n"
           "    if [[ $cur == -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$options\" -- \"$cur\"))\n"
           "        return\n"
           "    fi\n"
           "    compopt -o filenames\n"
           "    mapfile -t COMPREPLY < <(compgen -f -- \"$cur\")  # names with spaces stay whole\n"
           "    if ((COMP_CWORD == 1)); then\n"
           "        COMPREPLY+=($(compgen -W \"$commands\" -- \"$cur\"))\n"
           "    fi\n"
           "}\n"
           "complete -F _dibhr dibhr\n";
    return script.str();
}

/// Escapes brackets and colons, which mean something to _arguments.
std::string zsh_text(const std::string& text) {
    std::string safe = text;
    for (const char* special : {"[", "]", ":"})
        safe = replaced(safe, special, std::string("\\") + special);
    return safe;
}

std::string zsh_completion(const std::vector<DocumentedCommand>& commands) {
    std::ostringstream script;
    script << "#compdef dibhr\n"
              "_dibhr() {\n"
              "    local -a commands=(\n";
    for (const DocumentedCommand& command : commands)
        script << "        " << quoted(command.name + ':' + zsh_text(command.summary)) << '\n';
    script << "        'help:The options of a command'\n"
              "        'completion:A script for a shell'\n"
              "    )\n"
              "    if (( CURRENT == 2 )); then\n"
              "        [[ $words[2] == -* ]] || { _describe command commands; _files; return }\n"
              "    fi\n"
              "    local command=view\n"
              "    if (( ${commands[(I)$words[2]:*]} )); then\n"
              "        command=$words[2]\n"
              "        shift words\n"
              "        (( CURRENT-- ))\n"
              "    fi\n"
              "    case $command in\n"
              "        help) compadd keys; _describe command commands ;;\n"
              "        completion) _values shell bash zsh fish ;;\n";
    for (const DocumentedCommand& command : commands) {
        script << "        " << command.name << ")\n            _arguments";
        for (const DocumentedOption& option : command.options) {
            if (option.is_argument()) continue;
            std::string form = option.names.front() + '[' + zsh_text(option.help) + ']';
            if (!option.type.empty()) {
                form += ':' + zsh_text(option.type) + ':';
                const std::vector<std::string> values = option.values();
                if (!values.empty()) form += '(' + listed(values, " ") + ')';
                if (option.takes_file()) form += "_files";
            }
            script << " \\\n                " << quoted(form);
        }
        script << " \\\n                '*:file:_files' ;;\n";
    }
    // zsh loads the script by its name from its folders, or .zshrc sources it.
    script << "    esac\n}\n"
              "if [[ ${funcstack[1]} == _dibhr ]]; then\n"
              "    _dibhr \"$@\"\n"
              "else\n"
              "    compdef _dibhr dibhr\n"
              "fi\n";
    return script.str();
}

std::string fish_completion(const std::vector<DocumentedCommand>& commands) {
    std::ostringstream script;
    script << "# fish completion of dibhr\n";
    const std::string names = names_of(commands);
    for (const DocumentedCommand& command : commands) {
        script << "complete -c dibhr -n '__fish_is_first_arg' -a " << command.name << " -d "
               << quoted(command.summary) << '\n';
    }
    script << "complete -c dibhr -n '__fish_is_first_arg' -a help -d 'The options of a command'\n"
              "complete -c dibhr -n '__fish_is_first_arg' -a completion -d 'A script for a shell'\n"
              "complete -c dibhr -f -n '__fish_seen_subcommand_from help' -a '"
           << names
           << " keys'\n"
              "complete -c dibhr -f -n '__fish_seen_subcommand_from completion' -a 'bash zsh "
              "fish'\n";
    for (const DocumentedCommand& command : commands) {
        // Options without a command are the viewer's.
        const std::string when =
            command.name == "view"
                ? "not __fish_seen_subcommand_from " + replaced(names, "view ", "")
                : "__fish_seen_subcommand_from " + command.name;
        for (const DocumentedOption& option : command.options) {
            if (option.is_argument() || !option.names.front().starts_with("--")) continue;
            script << "complete -c dibhr -n '" << when << "' -l " << option.names.front().substr(2)
                   << " -d " << quoted(option.help);
            const std::vector<std::string> values = option.values();
            if (option.takes_file()) {
                script << " -r -F";
            } else if (!option.type.empty()) {
                script << " -x";
                if (!values.empty()) script << " -a '" << listed(values, " ") << "'";
            }
            script << '\n';
        }
    }
    return script.str();
}

}  // namespace

bool DocumentedOption::takes_file() const {
    return type == "FILE" || type == "IMAGE" || type == "DIR" ||
           type.find('.') != std::string::npos;
}

std::vector<std::string> DocumentedOption::values() const {
    if (std::vector<std::string> choices = split(type, "|");
        choices.size() > 1 && std::ranges::all_of(choices, is_bare_name))
        return choices;
    if (type != "NAME" && type != "WORD") return {};
    const std::size_t colon = help.find(": ");
    if (colon == std::string::npos) return {};
    const std::string listed = help.substr(colon + 2);
    // "raw (nothing), gentle"; text after a semicolon describes them.
    std::vector<std::string> words =
        split(without_parentheses(listed.substr(0, listed.find(';'))), ", ");
    // "relief: the picture plane; true: the shape: auto, relief, true"
    if (const std::size_t last = help.rfind(": "); last != colon)
        words = split(without_parentheses(help.substr(last + 2)), ", ");
    std::erase_if(words, [](const std::string& word) { return !is_bare_name(word); });
    return words;
}

std::string man_page(const std::vector<DocumentedCommand>& commands) {
    std::ostringstream page;
    page << ".TH DIBHR 1 \"\" \"dibhr " << DIBHR_VERSION
         << "\" \"User Commands\"\n"
            ".SH NAME\n"
            "dibhr \\- touch recorded 3D video with a force device or the mouse\n"
            ".SH SYNOPSIS\n";
    for (const DocumentedCommand& command : commands) {
        const std::string name = command.name == "view" ? "[view]" : command.name;
        page << ".B dibhr " << troff(name) << "\n.I " << troff(command.arguments) << "\n.br\n";
    }
    page
        << ".B dibhr help\n.RI [ COMMAND ]\n.br\n.B dibhr completion\n.I bash|zsh|fish\n"
           ".SH DESCRIPTION\n"
           "Colour and depth video is shown as a moving relief that a hand feels: contact, "
           "friction and roughness are rendered a thousand times a second with Depth Image\\-Based "
           "Haptic Rendering (Cha, Eid and El Saddik, EuroHaptics 2008).\n"
           "A word that is not a command names a file for the viewer to show.\n"
           ".SH COMMANDS\n";
    for (const DocumentedCommand& command : commands) add_command(page, command);
    add_keys(page);
    page << ".SH EXIT STATUS\n"
            "0 on success, 1 on a failure it explains, 2 on bad usage; 130 if Ctrl+C ended a "
            "command before it was done. The viewer ends with 0 after Ctrl+C.\n"
            ".SH FILES\n"
            ".TP\n\\fI~/.config/dibhr/settings.toml\\fR\nWhat a person changed in the window.\n"
            ".TP\n\\fI~/.config/dibhr/materials\\fR\nMaterials of one's own.\n"
            ".TP\n\\fI~/.local/state/dibhr/recent\\fR\nFiles opened before.\n"
            ".TP\n\\fI~/.local/state/dibhr/agreed\\fR\nSettings that protect the hand less, and "
            "commands to run, to which somebody agreed.\n";
    return page.str();
}

std::string keys_help(const KeyTable& keys) {
    std::size_t names = 0;
    std::size_t shown = 0;
    for (const KeyJob& job : key_jobs()) {
        names = std::max(names, job.name.size());
        shown = std::max(shown, keys.names_for(job.action).size());
    }
    std::ostringstream text;
    text << std::left;
    for (const KeyJob& job : key_jobs())
        text << "  " << std::setw(static_cast<int>(names) + 2) << job.name
             << std::setw(static_cast<int>(shown) + 2) << keys.names_for(job.action) << job.help
             << '\n';
    text << '\n' << kOwnKeys << '\n' << kOwnKeysExample << '\n' << kOwnKeysRules << '\n';
    return text.str();
}

std::string completion_for(std::string_view shell, const std::vector<DocumentedCommand>& commands) {
    if (shell == "bash") return bash_completion(commands);
    if (shell == "zsh") return zsh_completion(commands);
    if (shell == "fish") return fish_completion(commands);
    throw UsageError("there is no completion for " + in_quotes(std::string(shell)) +
                     "; choose bash, zsh or fish");
}

}  // namespace dibhr
