// SPDX-License-Identifier: MIT
// A program that speaks the protocol as text and knows the octahedron at depth 0, until it does what its
// words say: THING, or THING at hello|create|end. Everything here is wrong on purpose.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "verify/host/isolation/test_subjects/things.h"

namespace {

std::string thing, place = "tessellate";

void say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}
void say_status(const char* status) {
  say(std::string(R"({"limitcheck": 1, "status": ")") + status + R"(", "message": "no luck"})" + "\n");
  _exit(0);
}

// Answers that are none, or announce what cannot be; nothing comes after them.
const std::map<std::string, std::string>& answers() {
  const auto counts = [](const std::string& vertices, const std::string& triangles) {
    return R"({"status": "ok", "vertices": )" + vertices + R"(, "triangles": )" + triangles + "}\n";
  };
  static const std::map<std::string, std::string> all{
      {"chatter", "hello there\n"},
      {"no_end_of_line", std::string(100000, 'x')},
      {"nested", std::string(60000, '[') + "\n"},
      {"nested_value", counts(std::string(12000, '[') + std::string(12000, ']'), "8")},
      {"not_utf8", "{\"status\": \"\xff\xfe\"}\n"},
      {"counts_1e18", counts("1000000000000000000", "1")},
      {"counts_negative", counts("6", "-8")},
      {"counts_real", counts("6.5", "8")},
      {"counts_text", counts("\"6\"", "8")},
      {"no_counts", "{\"status\": \"ok\"}\n"}};
  return all;
}

void misbehave(const std::string& here) {
  if (place != here) return;
  if (const auto known = things().find(thing); known != things().end()) return known->second();
  if (const auto answer = answers().find(thing); answer != answers().end())
    say(answer->second), sleep_for_ever();
  if (thing.starts_with("exit")) _exit(std::atoi(thing.c_str() + 4));
  if (thing == "complain") std::fputs("no luck today\n", stderr), _exit(1);
  if (thing == "in_the_middle")
    say(R"({"status": "ok", "vertices": 6, "triangles": 8})"
        "\n1 2 3"),
        _exit(0);
  while (thing == "drip") say(" "), usleep(10000);
  if (thing == "deaf" || thing == "dumb") close(0), close(1), sleep_for_ever();
  if (thing == "failed") say_status("failed");
  if (thing == "not_supported") say_status("not-supported");
  if (thing == "other_status") say_status("so-so");
  if (thing == "more" && here == "end") say("more\n");
}

}  // namespace

int main(int count, char** words) {
  if (count > 1) thing = words[1];
  if (count > 3) place = words[3];
  const auto lines = [](int n) {
    std::vector<std::string> all(n);
    for (std::string& line : all) std::getline(std::cin, line);
    return all;
  };
  const auto number = [](const std::string& line, const char* key) {
    const std::size_t at = line.find(std::string("\"") + key + "\":");
    return at == std::string::npos ? 0 : std::atoi(line.c_str() + at + std::strlen(key) + 3);
  };
  std::vector<std::string> points, faces;
  for (std::string line; std::getline(std::cin, line);) {
    if (line.find("\"capabilities\"") != std::string::npos) {
      misbehave("hello");
      say(R"({"limitcheck": 1, "status": "ok", "payload": "text", "precision": "float32", "weights": "loop", )"
          R"("boundary": "none", "points": "limit", "max_depth": 0, "normals": false, "per_face_depth": false, )"
          R"("exact_lattice": true})"
          "\n");
    } else if (line.find("\"create\"") != std::string::npos) {
      points = lines(number(line, "vertices"));
      faces = lines(number(line, "triangles"));
      misbehave("create");
      say(R"({"status": "ok"})"
          "\n");
    } else {
      (void)lines(number(line, "triangles"));
      misbehave("tessellate");
      std::ostringstream out;
      out << R"({"status": "ok", "vertices": )" << points.size() << R"(, "triangles": )" << faces.size()
          << "}\n";
      for (std::size_t v = 0; v < points.size(); ++v) {
        if (thing == "short_row" && v == 0) out << "1 2\n";
        if (thing == "words" && v == 0) out << "one two three\n";
        std::size_t f = 0, corner = 3;
        for (; f < faces.size() && corner == 3; ++f) {
          std::istringstream in(faces[f]);
          std::array<std::size_t, 3> c{};
          in >> c[0] >> c[1] >> c[2];
          for (std::size_t k = 0; k < 3; ++k)
            if (c[k] == v) corner = k;
        }
        std::istringstream in(points[v]);
        for (double x = 0; in >> x;) {
          if (thing == "tiny_number" && x == 0)
            out << "1e-50 ";
          else
            out << x * 24 / 55 << ' ';
        }
        out << f - 1 << ' ' << (corner == 1) << ' ' << (corner == 2) << " 1";
        out << (thing == "long_row" && v == 0 ? " 7\n" : "\n");
      }
      for (std::size_t f = 0; f < faces.size(); ++f)
        out << (thing == "index_beyond" && f == 0 ? "0 1 77" : faces[f].c_str()) << ' ' << f << '\n';
      if (thing == "more" && place == "tessellate") out << "more\n";
      say(out.str());
    }
  }
  misbehave("end");
  return 0;
}
