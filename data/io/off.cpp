// SPDX-License-Identifier: MIT
// Object File Format (Geomview), text: OFF, and with colours, normals, texture coordinates, which are read
// over.
#include <fmt/core.h>

#include "data/io/polygon_soup.h"
#include "data/io/text_scanner.h"

namespace limitcheck::data::io {
namespace {

// The numbers that follow x, y, z in the lines of a header such as STCNOFF: 2 texture coordinates, 3 or 4 of
// a colour, 3 of a normal.
struct Extra {
  int least = 0, most = 0;
};

class OffReader {
 public:
  OffReader(std::string_view content, const std::string& name) : scanner_(content, name, '#') {}

  PolygonSoup read() {
    const Extra extra = read_header();
    for (std::int64_t i = 0; i < vertices_; ++i) {
      if (!scanner_.next_line())
        scanner_.truncated(fmt::format("ends after {} of {} vertices", i, vertices_));
      read_vertex(extra);
    }
    for (std::int64_t i = 0; i < faces_; ++i) {
      if (!scanner_.next_line()) scanner_.truncated(fmt::format("ends after {} of {} faces", i, faces_));
      read_face();
    }
    if (scanner_.next_line()) {
      scanner_.syntax_error(
          fmt::format("more lines than the {} vertices and {} faces announced", vertices_, faces_));
    }
    return std::move(soup_);
  }

 private:
  Extra read_header() {
    if (!scanner_.next_line()) scanner_.truncated("has no lines");
    Extra extra;
    std::string_view word = scanner_.word();
    const std::string_view whole = word;
    const auto drop = [&](std::string_view prefix, int least, int most) {
      if (!word.starts_with(prefix)) return;
      word.remove_prefix(prefix.size());
      extra.least += least;
      extra.most += most;
    };
    drop("ST", 2, 2);
    drop("C", 3, 4);
    drop("N", 3, 3);
    if (word == "4OFF" || word == "nOFF" || word == "4nOFF") {
      scanner_.fail("FILE_UNSUPPORTED", "only three-dimensional OFF is read");
    }
    if (word != "OFF") scanner_.syntax_error(fmt::format("begins with {}, not with OFF", quoted(whole)));

    // The counts follow on the same line or on the next.
    word = scanner_.word();
    if (word == "BINARY") scanner_.fail("FILE_UNSUPPORTED", "binary OFF is not read");
    if (word.empty()) {
      if (!scanner_.next_line()) scanner_.truncated("ends before the counts");
      word = scanner_.word();
    }
    const auto vertices = to_integer(word);
    if (!vertices || *vertices < 0) {
      scanner_.syntax_error(fmt::format("the number of vertices is not a count: {}", quoted(word)));
    }
    vertices_ = *vertices;
    faces_ = scanner_.integer("the number of faces");
    if (faces_ < 0) scanner_.syntax_error(fmt::format("{} faces", faces_));
    word = scanner_.word();  // the number of edges, of no use and often 0
    if (!word.empty() && !to_integer(word)) scanner_.syntax_error(fmt::format("unexpected {}", quoted(word)));
    scanner_.end_of_line();
    return extra;
  }

  void read_vertex(const Extra& extra) {
    const double x = scanner_.number("x"), y = scanner_.number("y"), z = scanner_.number("z");
    if (scanner_.pass_numbers(extra.most) < extra.least)
      scanner_.syntax_error("too few numbers for a vertex");
    soup_.positions.push_back({x, y, z});
    soup_.position_lines.push_back(scanner_.line());
  }

  // n i1 ... in, then up to four numbers of a colour.
  void read_face() {
    const std::int64_t corners = scanner_.integer("the number of corners");
    for (std::int64_t k = 0; k < corners; ++k) soup_.corners.push_back(scanner_.integer("a corner"));
    scanner_.pass_numbers(4);
    soup_.close_polygon(scanner_.line());
  }

  TextScanner scanner_;
  std::int64_t vertices_ = 0, faces_ = 0;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_off(std::string_view content, const std::string& name) {
  return OffReader(content, name).read();
}

}  // namespace limitcheck::data::io
