// SPDX-License-Identifier: MIT
// Text as wide as the screen that it is for: sentences that are broken at blanks, tables that leave out what has no room.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace limitcheck::verify {

/// What a report is shown on.
struct Screen {
  bool colour = false;    // whether it takes ANSI colours
  std::size_t width = 0;  // in columns; 0: lines may be as long as they are
};

/// Lines that are wider than the screen are broken at blanks, or else behind commas. What is carried over begins where
/// the line does, or under its second column, if there are two blanks or more before one; or behind `hang` blanks.
/// Escape sequences have no width. A word that is wider than the screen stays whole, and a line that is a command.
std::string wrapped(const std::string& text, std::size_t width, std::optional<std::size_t> hang = {});

struct TableCell {
  std::string text;
  const char* colour = nullptr;  // the number of an ANSI colour
};

struct Column {
  std::string title;
  std::size_t least;    // columns that it takes at least, if the screen has room
  bool right = false;   // numbers stand right
  std::size_t gap = 1;  // blanks before it, if the screen has room
  int leaves = 0;  // where there is no room the column with the smallest such number goes first; 0: it stays
};

/// A row has a cell for each column.
struct TableRow {
  std::vector<TableCell> cells = {};
  bool weighty = false;  // the last column has a line of its own if there is no room for it
};

/// A line of titles and a line for each row, with `indent` blanks in front.
std::string table(std::vector<Column> columns, const std::vector<TableRow>& rows, const Screen& screen,
                  std::size_t indent);

/// The same with all columns: those that have no room stand below, behind the first column again.
std::string table_in_blocks(const std::vector<Column>& columns, const std::vector<TableRow>& rows,
                            const Screen& screen, std::size_t indent);

}  // namespace limitcheck::verify
