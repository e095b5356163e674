// SPDX-License-Identifier: MIT
#include "verify/report/forms.h"

#include <cctype>
#include <nlohmann/json.hpp>
#include <system_error>

#include "data/io/write.h"
#include "reference/surface/certified.h"
#include "verify/report/json.h"
#include "verify/row/commands.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::ordered_json;

// As part of a file's name.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' ? c : '_';
  constexpr std::size_t kLongest = 60;
  return out.size() > kLongest ? out.substr(out.size() - kLongest) : out;
}

// The limit surface at the witness, on the mesh as the subject gets it.
void add_limit(Json& json, const Result& r, data::ControlMesh mesh) {
  if (r.precision == LC_FLOAT32)
    for (auto& p : mesh.positions)
      for (double& x : p) x = static_cast<double>(static_cast<float>(x));
  constexpr int kDigits = 40;
  const reference::CertifiedEvaluator evaluator = r.scheme == data::Scheme::kLoop
                                                      ? reference::CertifiedEvaluator(mesh, r.weights)
                                                      : reference::CertifiedEvaluator(mesh, r.scheme);
  const auto point = evaluator.evaluate(static_cast<int>(r.witness->face), std::max(r.witness->corner, 0),
                                        reference::Parameter::parse(r.witness->l1),
                                        reference::Parameter::parse(r.witness->l2), kDigits);
  const auto vector = [](const auto& v) { return Json{v[0].value, v[1].value, v[2].value}; };
  json["limit_position"] = vector(point.position);
  json["limit_normal"] = vector(point.normal);
}

// Into `folder`, which will be `place`.
void write_files(const std::filesystem::path& folder, const std::filesystem::path& place,
                 const Result& result, const AuditMesh& mesh, const std::string& level) {
  data::write_mesh(folder / "control.obj", mesh.mesh);
  Result here = result;
  here.mesh = (place / "control.obj").string();
  here.triangulated.clear();  // the file has the triangles
  if (!mesh.face_depth.empty()) {
    std::string lines;
    for (const std::int32_t depth : mesh.face_depth) lines += std::to_string(depth) + "\n";
    write_text(folder / "depths.txt", lines);
    here.depths = after_of(result.depths) + "file:" + (place / "depths.txt").string();
  }

  Json json{{"subject", result.subject},
            {"check", result.check},
            {"status", word(result.status)},
            {"mesh", result.mesh},
            {"control", "control.obj"},
            {"scheme", data::name_of(result.scheme)},
            {"precision", result.precision == LC_FLOAT32 ? "float" : "double"},
            {"count", result.bad},
            {"of", result.of},
            {"worst", result.worst && std::isfinite(*result.worst) ? Json(*result.worst) : Json(nullptr)},
            {"bound", result.bound ? Json(*result.bound) : Json(nullptr)},
            {"unit", result.unit},
            {"message", result.message}};
  if (const std::string lost = data::left_out(mesh.mesh, data::FileFormat::kObj); !lost.empty())
    json["left_out"] = "control.obj has no place for " + lost;
  if (result.witness) {
    const Witness& w = *result.witness;
    json["face"] = w.face >= 0 ? Json(w.face) : Json(nullptr);
    json["corner"] = w.corner >= 0 ? Json(w.corner) : Json(nullptr);
    json["l1"] = w.l1.empty() ? Json(nullptr) : Json(w.l1);
    json["l2"] = w.l2.empty() ? Json(nullptr) : Json(w.l2);
    json["expected"] = numbers(w.expected);
    json["got"] = numbers(w.got);
    if (const std::string command = eval_command(here);
        !command.empty() && (w.channel.empty() || w.channel == "uv")) {  // control.obj has no other
      if (w.channel.empty()) add_limit(json, result, mesh.mesh);
      json["eval"] = command + " --digits 40";
    }
  }
  json["audit"] = audit_command(here, level);
  write_text(folder / "witness.json", json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

std::filesystem::path write_witness(const std::filesystem::path& folder, const Report& report,
                                    const Result& result, const AuditMesh& mesh, const std::string& level) {
  const std::filesystem::path place =
      folder / (plain(result.subject) + "-" + plain(result.check) + "-" + plain(case_name(report, result)));
  // It appears whole or not at all, in the place of an older one.
  const std::filesystem::path partial = place.string() + ".partial";
  std::filesystem::remove_all(partial);
  std::filesystem::create_directories(partial);
  try {
    write_files(partial, place, result, mesh, level);
    std::filesystem::remove_all(place);
    std::filesystem::rename(partial, place);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove_all(partial, ignored);
    throw;
  }
  return place;
}

}  // namespace limitcheck::verify
