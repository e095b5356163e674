// SPDX-License-Identifier: MIT
// Stereolithography, ascii and binary: triangles without shared vertices.
//
// Our own reader because neither library at hand gives line and reason of an error; CGAL keeps its points in
// an ordered map, which NaN upsets, and Assimp takes a file without endsolid for whole.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cctype>

#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/io/text_scanner.h"

namespace limitcheck::data::io {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;  // normal, three vertices, an attribute of two bytes

std::uint32_t little_endian(std::string_view content, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(content[at + i])) << 8 * i;
  }
  return bits;
}

// A line of ascii STL begins with these words, in any case.
void expect(TextScanner& scanner, std::initializer_list<std::string_view> words) {
  for (const std::string_view expected : words) {
    const std::string_view word = scanner.word();
    const bool same =
        std::equal(word.begin(), word.end(), expected.begin(), expected.end(),
                   [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
    if (!same) scanner.syntax_error(fmt::format("{} where \"{}\" is due", quoted(word), expected));
  }
}

bool begins_with(std::string_view word, char lower_case) {
  return !word.empty() && std::tolower(static_cast<unsigned char>(word[0])) == lower_case;
}

void read_ascii(std::string_view content, const std::string& name, PolygonSoup& soup) {
  TextScanner scanner(content, name, 0);
  const auto line = [&](std::string_view where) {
    if (!scanner.next_line()) scanner.truncated(fmt::format("ends within a {}", where));
  };
  while (scanner.next_line()) {
    expect(scanner, {"solid"});
    for (;;) {
      line("solid");
      if (begins_with(scanner.peek(), 'e')) break;
      const std::int64_t facet_line = scanner.line();
      expect(scanner, {"facet", "normal"});  // the numbers of the normal follow: of no use, and often wrong
      line("facet");
      expect(scanner, {"outer", "loop"});
      scanner.end_of_line();
      for (int k = 0; k < 3; ++k) {
        line("facet");
        expect(scanner, {"vertex"});
        const double x = scanner.number("x"), y = scanner.number("y"), z = scanner.number("z");
        scanner.end_of_line();
        soup.corners.push_back(static_cast<std::int64_t>(soup.positions.size()));
        soup.positions.push_back({x, y, z});
        soup.position_lines.push_back(scanner.line());
      }
      soup.close_polygon(facet_line);
      line("facet");
      expect(scanner, {"endloop"});
      line("facet");
      expect(scanner, {"endfacet"});
    }
    expect(scanner, {"endsolid"});
  }
}

void read_binary(std::string_view content, const std::string& name, PolygonSoup& soup) {
  const auto fail = [&](const std::string& code, const std::string& message) {
    throw InputError(code, name, 0, message);
  };
  if (content.size() < kHeaderBytes)
    fail("FILE_TRUNCATED", fmt::format("{} bytes, shorter than a header", content.size()));
  const std::size_t announced = little_endian(content, kHeaderBytes - 4);
  const std::size_t present = (content.size() - kHeaderBytes) / kFacetBytes;
  if (present < announced)
    fail("FILE_TRUNCATED", fmt::format("ends after {} of {} facets", present, announced));
  if (content.size() != kHeaderBytes + announced * kFacetBytes) {
    fail("FILE_SYNTAX", fmt::format("{} bytes more than {} facets take",
                                    content.size() - kHeaderBytes - announced * kFacetBytes, announced));
  }
  for (std::size_t f = 0; f < announced; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = kHeaderBytes + f * kFacetBytes + 12 * (k + 1);
      std::array<double, 3> position{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        position[axis] = std::bit_cast<float>(little_endian(content, at + 4 * axis));
      }
      soup.corners.push_back(static_cast<std::int64_t>(soup.positions.size()));
      soup.positions.push_back(position);
    }
    soup.close_polygon();
  }
}

// Binary files may begin with "solid" too; those have zero bytes in their count or their numbers, or the
// right size.
bool is_ascii(std::string_view content) {
  if (content.size() >= kHeaderBytes &&
      content.size() == kHeaderBytes + std::size_t{little_endian(content, kHeaderBytes - 4)} * kFacetBytes) {
    return false;
  }
  TextScanner scanner(content.substr(0, 4096), "", 0);
  return scanner.next_line() && begins_with(scanner.peek(), 's') &&
         content.substr(0, 4096).find('\0') == std::string_view::npos;
}

}  // namespace

PolygonSoup read_stl(std::string_view content, const std::string& name) {
  PolygonSoup soup;
  if (is_ascii(content)) {
    read_ascii(content, name, soup);
  } else {
    read_binary(content, name, soup);
  }
  join_equal_positions(soup);
  return soup;
}

}  // namespace limitcheck::data::io
