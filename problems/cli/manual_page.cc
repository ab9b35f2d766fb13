// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/manual_page.h"

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <vector>

#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

constexpr char kEnvironment[] = R"(.SH ENVIRONMENT
.TP
\fBPHONGPD_CACHE_DIR\fR
Folder of the cache of contact spaces, for one user: \fI$XDG_CACHE_HOME/phongpd\fR
or \fI\(ti/.cache/phongpd\fR if it is not set.
)";

// What roff spells differently; nullptr if it does not.
const char* Spelling(char c) {
  switch (c) {
    case '\\':
      return "\\e";
    case '-':
      return "\\-";
    case '\'':
      return "\\(aq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    case '"':
      return "\\(dq";
    default:
      return nullptr;
  }
}

// The code point that begins at text[*i] in UTF-8; moves *i to its last byte.
std::uint32_t CodePoint(const std::string& text, std::size_t* i) {
  const auto byte = [&](std::size_t at) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[at]));
  };
  const std::uint32_t first = byte(*i);
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  std::uint32_t code = first & (0x3FU >> more);
  for (int k = 0; k < more && *i + 1 < text.size(); ++k) {
    code = (code << 6) | (byte(++*i) & 0x3FU);
  }
  return code;
}

// "\fB--seed\fR \fIS\fR", or the name of a positional argument.
std::string Tag(const Argument& argument) {
  std::string tag;
  for (const std::string& name : argument.names) {
    tag += (tag.empty() ? "\\fB" : ", \\fB") + RoffEscaped(name) + "\\fR";
  }
  if (!argument.title.empty()) {
    tag += (tag.empty() ? "\\fI" : " \\fI") + RoffEscaped(argument.title) +
           "\\fR" + (argument.repeats ? " ..." : "");
  }
  return tag;
}

std::string Entry(const Argument& argument) {
  std::string text =
      ".TP\n" + Tag(argument) + '\n' + RoffEscaped(argument.help) + '.';
  if (!argument.choices.empty()) {
    text += " One of: " + RoffEscaped(Joined(argument.choices)) + '.';
  }
  if (!argument.fallback.empty()) {
    text += " Default: " + RoffEscaped(argument.fallback) + '.';
  }
  if (argument.required && !argument.names.empty()) text += " Required.";
  return text + '\n';
}

// What follows the command's name on its line.
std::string Usage(const CommandNode& node) {
  std::string usage;
  for (const Argument& flag : node.flags) {
    if (flag.required) usage += ' ' + Tag(flag);
  }
  usage += " [\\fIOPTION\\fR ...]";
  for (const Argument& argument : node.positionals) {
    usage +=
        argument.required ? ' ' + Tag(argument) : " [" + Tag(argument) + ']';
  }
  return usage;
}

// A footer, line by line.
std::string Verbatim(const std::string& text) {
  if (text.empty()) return "";
  return ".PP\n.nf\n" + RoffEscaped(text) + (text.back() == '\n' ? "" : "\n") +
         ".fi\n";
}

std::string Section(const CommandNode& node) {
  const std::string name = "phongpd " + Joined(node.path, " ");
  std::string text = ".SS " + RoffEscaped(name) + '\n' +
                     RoffEscaped(node.summary) + ".\n.PP\n\\fB" +
                     RoffEscaped(name) + "\\fR" + Usage(node) + '\n';
  for (const Argument& argument : node.positionals) text += Entry(argument);
  for (const Argument& flag : node.flags) text += Entry(flag);
  return text + Verbatim(node.examples);
}

}  // namespace

std::string RoffEscaped(const std::string& text) {
  std::ostringstream out;
  bool begins_line = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (begins_line && c == '.') out << "\\&";
    begins_line = c == '\n';
    if (static_cast<unsigned char>(c) >= 0x80) {
      out << "\\[u" << std::uppercase << std::hex << std::setw(4)
          << std::setfill('0') << CodePoint(text, &i) << ']';
    } else if (const char* const spelling = Spelling(c)) {
      out << spelling;
    } else {
      out << c;
    }
  }
  return out.str();
}

std::string ManualPage(const CommandNode& program, const std::string& version) {
  std::string text =
      ".\\\" By: phongpd man\n"
      ".TH PHONGPD 1 \"\" \"PhongPD " +
      RoffEscaped(version) +
      "\" \"PhongPD\"\n"
      ".ad l\n"
      ".SH NAME\n"
      "phongpd \\- penetration depth on exact contact spaces, trajectories and "
      "plans\n"
      ".SH SYNOPSIS\n"
      "\\fBphongpd\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR ...]\n"
      ".SH DESCRIPTION\n";
  for (std::size_t i = 0; i < program.summary.size();) {
    const std::size_t end =
        std::min(program.summary.find('\n', i), program.summary.size());
    text += (i == 0 ? "" : ".PP\n") +
            RoffEscaped(program.summary.substr(i, end - i)) + '\n';
    i = end + 1;
  }
  for (const Argument& flag : program.flags) text += Entry(flag);
  text += ".SH COMMANDS\n";
  for (const CommandNode* const node : AllNodes(program)) {
    if (node->path.empty() || !node->commands.empty()) continue;
    text += Section(*node);
  }
  return text + kEnvironment;
}

}  // namespace phongpd::cli
