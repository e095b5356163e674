// SPDX-License-Identifier: MIT
#include "verify/host/isolation/witness.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "data/io/write.h"
#include "data/validate.h"
#include "verify/subject/control_mesh.h"

namespace limitcheck::verify {
namespace {

std::uint64_t fnv1a(std::string_view text, std::uint64_t hash) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

std::string shell_word(const std::string& text) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:,=+-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string inside;
  for (const char c : text) {
    if (c == '\'') {
      inside += "'\\''";
    } else {
      inside += c;
    }
  }
  return fmt::format("'{}'", inside);
}

std::string save_input(const std::string& folder, const Input& input) try {
  std::string command = fmt::format("limitcheck audit {}{}{}", input.flag, input.flag.empty() ? "" : " ",
                                    shell_word(input.what));
  std::string rest = input.isolate ? " --isolate" : "";
  if (!input.options.empty()) rest += fmt::format(" --options {}", shell_word(input.options));
  if (input.limits.seconds != ProcessLimits().seconds)
    rest += fmt::format(" --timeout {}", input.limits.seconds);
  if (input.limits.memory_mib != ProcessLimits().memory_mib)
    rest += fmt::format(" --memory {}", input.limits.memory_mib);
  if (input.mesh == nullptr || folder.empty()) return fmt::format("; again with: {}{}", command, rest);

  const std::filesystem::path place(folder);
  std::filesystem::create_directories(place);
  const data::ControlMesh mesh = control_mesh(*input.mesh);
  const std::uint64_t hash = fnv1a(data::mesh_content(mesh, data::FileFormat::kObj), 0xcbf29ce484222325ULL);
  const auto mesh_file = place / fmt::format("{:016x}.obj", hash);
  data::write_mesh(mesh_file, mesh);
  command += fmt::format(" {}", shell_word(mesh_file.string()));
  const data::Scheme scheme =
      input.mesh->scheme == LC_SCHEME_CATMULL_CLARK ? data::Scheme::kCatmullClark : data::Scheme::kLoop;
  if (scheme != data::natural_scheme(mesh)) command += fmt::format(" --scheme {}", data::name_of(scheme));
  if (!data::validate(mesh, scheme).empty())
    return fmt::format("; again with: {}{} --must-refuse", command, rest);

  if (!input.face_depth.empty()) {
    const auto [least, most] = std::minmax_element(input.face_depth.begin(), input.face_depth.end());
    command += fmt::format(" --depth {}", std::max(*most, 0));
    if (*least != *most || *least < 0) {
      std::string lines;
      for (const std::int32_t d : input.face_depth) lines += fmt::format("{}\n", d);
      const auto depth_file = place / fmt::format("{:016x}.depths", fnv1a(lines, hash));
      std::ofstream out(depth_file, std::ios::binary);
      out << lines;
      out.close();
      if (!out) return fmt::format("; cannot write {}", depth_file.string());
      command += fmt::format(" --depths {}", shell_word(fmt::format("file:{}", depth_file.string())));
    }
  }
  return fmt::format("; again with: {}{}", command, rest);
} catch (const std::exception& error) {
  return fmt::format("; its input could not be saved: {}", error.what());
}

}  // namespace limitcheck::verify
