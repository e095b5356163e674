// SPDX-License-Identifier: MIT
#include "verify/files/read/provenance.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "data/error.h"
#include "data/io/text_scanner.h"
#include "data/io/whole_content.h"
#include "reference/point/parameter.h"

namespace limitcheck::verify {
namespace {

using data::InputError;
using Words = std::vector<std::string_view>;

// The tab parts words, too.
Words split(std::string_view line) {
  constexpr std::string_view kSpace = " \n\v\f\r";
  Words words;
  for (std::size_t begin = 0, end = 0; begin <= line.size(); begin = end + 1) {
    end = std::min(line.find_first_of(",;\t", begin), line.size());
    std::string_view word = line.substr(begin, end - begin);
    word.remove_prefix(std::min(word.find_first_not_of(kSpace), word.size()));
    words.push_back(word.substr(0, word.find_last_not_of(kSpace) + 1));
  }
  return words;
}

constexpr std::string_view kColumns[] = {"vertex", "face", "l1", "l2", "i", "j", "denominator", "corner"};
enum Column { kVertex, kFace, kL1, kL2, kI, kJ, kDenominator, kCorner, kCount };

Column column(std::string_view word) {
  if (word == "u") return kL1;
  if (word == "v") return kL2;
  return static_cast<Column>(std::find(std::begin(kColumns), std::end(kColumns), word) -
                             std::begin(kColumns));
}

}  // namespace

std::vector<ProvenanceRow> parse_provenance(std::string_view content, const std::string& name,
                                            std::int64_t vertices, const data::ControlMesh& control,
                                            data::Scheme scheme) {
  const auto faces = static_cast<std::int64_t>(control.faces.size());
  std::vector<ProvenanceRow> rows;
  std::vector<bool> named(vertices, false);
  std::array<int, kCount> place{};
  place.fill(-1);
  std::size_t width = 0;
  std::int64_t line = 0;
  const auto fail = [&](const char* code, const std::string& message) {
    throw InputError(code, name, line, message);
  };
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = std::min(content.find('\n', at), content.size());
    const std::string_view text = content.substr(at, end - at);
    at = end + 1;
    ++line;
    const Words words = split(text);
    if (text.starts_with('#') || (words.size() == 1 && words[0].empty())) continue;

    if (width == 0) {
      width = words.size();
      const bool heading = !words[0].empty() && std::isalpha(static_cast<unsigned char>(words[0][0])) != 0;
      const Words names = heading      ? words
                          : width == 4 ? split("vertex,face,l1,l2")
                                       : split("vertex,face,i,j,denominator");
      for (std::size_t k = 0; k < names.size() && (heading || width == 4 || width == 5); ++k)
        if (const Column c = column(names[k]); c != kCount) place[c] = static_cast<int>(k);
      const bool real = place[kL1] >= 0 && place[kL2] >= 0;
      const bool lattice = place[kI] >= 0 && place[kJ] >= 0 && place[kDenominator] >= 0;
      if (place[kVertex] < 0 || place[kFace] < 0 || !(real || lattice))
        fail("FILE_SYNTAX", "the columns are vertex,face,l1,l2 or vertex,face,i,j,denominator");
      if (heading) continue;
    }
    if (words.size() != width) fail("FILE_SYNTAX", fmt::format("{} columns, not {}", words.size(), width));
    const auto integer = [&](Column column) {
      const auto value = data::io::to_integer(words[place[column]]);
      if (!value)
        fail("FILE_SYNTAX", fmt::format("{} is not an integer: {}", kColumns[column],
                                        data::io::quoted(words[place[column]])));
      return *value;
    };
    ProvenanceRow row;
    row.vertex = integer(kVertex);
    const std::int64_t face = integer(kFace);
    if (row.vertex < 0 || row.vertex >= vertices)
      fail("FILE_PROVENANCE", fmt::format("vertex {}, the tessellation has {}", row.vertex, vertices));
    if (face < 0 || face >= faces)
      fail("FILE_PROVENANCE", fmt::format("face {}, the control mesh has {}", face, faces));
    if (named[row.vertex]) fail("FILE_PROVENANCE", fmt::format("vertex {} for the second time", row.vertex));
    named[row.vertex] = true;
    reference::Parameter l1(0.0), l2(0.0);
    try {
      if (place[kL1] >= 0) {
        l1 = reference::Parameter::parse(words[place[kL1]]);
        l2 = reference::Parameter::parse(words[place[kL2]]);
      } else {
        l1 = reference::Parameter::fraction(integer(kI), integer(kDenominator));
        l2 = reference::Parameter::fraction(integer(kJ), integer(kDenominator));
      }
    } catch (const data::ArgumentError& error) {
      fail("FILE_SYNTAX", error.what());
    }
    const double a = l1.as_double(), b = l2.as_double();
    row.at.face = static_cast<std::int32_t>(face);
    if (scheme == data::Scheme::kCatmullClark) {
      const auto corners = static_cast<std::int64_t>(control.faces[static_cast<std::size_t>(face)].size());
      const bool told = place[kCorner] >= 0 && !words[place[kCorner]].empty();
      const std::int64_t corner = told ? integer(kCorner) : -1;
      if (corners == 4 ? told && corner != 0 : corner < 0 || corner >= corners)
        fail("FILE_PROVENANCE",
             fmt::format("face {} has {} corners: {}", face, corners,
                         corners == 4 ? "it is one quad, of corner 0"
                                      : "the column corner says which of its quads is meant"));
      if (!(a >= 0 && a <= 1 && b >= 0 && b <= 1))
        fail("FILE_PROVENANCE", fmt::format("({}, {}) is outside the unit square", a, b));
      row.at.l = Chart::at(a, b);
      row.corner = corners == 4 ? -1 : static_cast<int>(corner);
    } else {
      // Decimals of l1 and l2 may sum to a little more than 1.
      if (!(a >= 0 && b >= 0 && a + b <= 1 + 1e-9))
        fail("FILE_PROVENANCE", fmt::format("({}, {}) is outside the face", a, b));
      row.at.l = clamped({reference::Parameter::complement(l1, l2).as_double(), a, b});
    }
    rows.push_back(row);
  }
  if (rows.empty()) throw InputError("FILE_TRUNCATED", name, 0, "no rows");
  return rows;
}

std::vector<ProvenanceRow> read_provenance(const std::filesystem::path& file, std::int64_t vertices,
                                           const data::ControlMesh& control, data::Scheme scheme) {
  return parse_provenance(data::io::whole_content(file), file.string(), vertices, control, scheme);
}

}  // namespace limitcheck::verify
