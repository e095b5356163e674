// SPDX-License-Identifier: MIT
#include "verify/report/columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace limitcheck::verify {
namespace {

// For each byte, and for the end, how many characters are seen before it: of UTF-8, without escape sequences.
std::vector<std::size_t> columns_of(std::string_view text) {
  std::vector<std::size_t> columns{0};
  bool escape = false;
  for (const char c : text) {
    if (c == '\033') escape = true;
    const bool is_seen = !escape && (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    columns.push_back(columns.back() + (is_seen ? 1 : 0));
    if (c == 'm') escape = false;
  }
  return columns;
}
std::size_t width_of(std::string_view text) {
  return columns_of(text).back();
}

// Where what is carried over of a line begins.
std::size_t hang_of(const std::string& line, std::size_t width) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", begin);
  if (gap == std::string::npos) return begin;
  const std::size_t second = line.find_first_not_of(' ', gap);
  if (second == std::string::npos) return begin;
  const std::size_t at = width_of(std::string_view(line).substr(0, second));
  return at <= width / 2 ? at : begin;
}

void add_wrapped(std::string& out, std::string line, std::size_t width, std::size_t blanks) {
  const std::string hang(blanks, ' ');
  for (std::vector<std::size_t> column = columns_of(line); column.back() > width; column = columns_of(line)) {
    std::size_t blank = 0, comma = 0;
    const std::size_t begin = std::max(line.find_first_not_of(' '), hang.size());
    for (std::size_t at = begin + 1; at < line.size() && column[at] <= width; ++at) {
      if (line[at] == ' ') blank = at;
      if (line[at] == ',' && column[at] + 1 < width) comma = at + 1;
    }
    if (blank == 0) blank = comma > 0 ? comma : line.find(' ', begin);
    const std::size_t next = line.find_first_not_of(' ', blank);
    if (blank == std::string::npos || next == std::string::npos) break;
    out += line.substr(0, line.find_last_not_of(' ', blank - 1) + 1) + "\n";
    line.replace(0, next, hang);
  }
  out += line;
}

std::string cell_text(const TableCell& cell, const Column& column, std::size_t width, const Screen& screen) {
  const std::string blanks(width - std::min(width, width_of(cell.text)), ' ');
  const std::string text = screen.colour && cell.colour != nullptr && !cell.text.empty()
                               ? fmt::format("\033[{}m{}\033[0m", cell.colour, cell.text)
                               : cell.text;
  return column.right ? blanks + text : text + blanks;
}

std::vector<std::size_t> widths_of(const std::vector<Column>& columns, const std::vector<TableRow>& rows) {
  std::vector<std::size_t> widths;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    widths.push_back(std::max(columns[k].least, width_of(columns[k].title)));
    for (const TableRow& row : rows) widths[k] = std::max(widths[k], width_of(row.cells[k].text));
  }
  return widths;
}

// The columns of these numbers; `all` are shown, if not here then elsewhere.
std::string lines(const std::vector<Column>& columns, const std::vector<TableRow>& rows,
                  const std::vector<std::size_t>& shown, const Screen& screen, std::size_t indent,
                  bool all = false) {
  const std::vector<std::size_t> widths = widths_of(columns, rows);
  std::string out;
  const auto add = [&](const auto& cell_of) {
    std::string line(indent, ' ');
    for (const std::size_t k : shown)
      line += std::string(k == shown.front() ? 0 : columns[k].gap, ' ') +
              cell_text(cell_of(k), columns[k], widths[k], screen);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  add([&](std::size_t k) { return TableCell{columns[k].title, nullptr}; });
  for (const TableRow& row : rows) {
    add([&](std::size_t k) { return row.cells[k]; });
    if (const std::string& last = row.cells.back().text;
        !all && row.weighty && !last.empty() && shown.back() + 1 < columns.size())
      out += std::string(indent + 4, ' ') + last + "\n";
  }
  return out;
}

std::size_t total(const std::vector<Column>& columns, const std::vector<std::size_t>& widths,
                  const std::vector<std::size_t>& shown, std::size_t indent) {
  std::size_t sum = indent;
  for (const std::size_t k : shown) sum += widths[k] + (k == shown.front() ? 0 : columns[k].gap);
  return sum;
}

/// "  limitcheck audit ..." and not "limitcheck 0.2.0: depth 4 on ...".
bool is_command(const std::string& line) {
  constexpr std::string_view kProgram = "limitcheck ";
  const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
  return line.compare(first, kProgram.size(), kProgram) == 0 && first + kProgram.size() < line.size() &&
         std::islower(static_cast<unsigned char>(line[first + kProgram.size()])) != 0;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width, std::optional<std::size_t> hang) {
  if (width == 0) return text;
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string line = text.substr(from, end - from);
    if (is_command(line))
      out += line;
    else
      add_wrapped(out, line, width, hang.value_or(hang_of(line, width)));
    if (end < text.size()) out += '\n';
    from = end + 1;
  }
  return out;
}

std::string table(std::vector<Column> columns, const std::vector<TableRow>& rows, const Screen& screen,
                  std::size_t indent) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < columns.size(); ++k) shown.push_back(k);
  const auto fits = [&] {
    return screen.width == 0 || total(columns, widths_of(columns, rows), shown, indent) <= screen.width;
  };
  if (!fits())
    for (Column& column : columns) column.least = 0, column.gap = 1;
  while (!fits()) {
    const auto first = std::ranges::min_element(shown, [&](std::size_t a, std::size_t b) {
      return columns[a].leaves > 0 && (columns[b].leaves == 0 || columns[a].leaves < columns[b].leaves);
    });
    if (columns[*first].leaves == 0) break;
    shown.erase(first);
  }
  return lines(columns, rows, shown, screen, indent);
}

std::string table_in_blocks(const std::vector<Column>& columns, const std::vector<TableRow>& rows,
                            const Screen& screen, std::size_t indent) {
  const std::vector<std::size_t> widths = widths_of(columns, rows);
  std::string out;
  std::vector<std::size_t> shown{0};
  for (std::size_t k = 1; k < columns.size(); ++k) {
    shown.push_back(k);
    if (screen.width == 0 || shown.size() == 2 || total(columns, widths, shown, indent) <= screen.width)
      continue;
    shown.pop_back();
    out += lines(columns, rows, shown, screen, indent, true) + "\n";
    shown = {0, k};
  }
  return out + lines(columns, rows, shown, screen, indent, true);
}

}  // namespace limitcheck::verify
