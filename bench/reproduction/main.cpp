// SPDX-License-Identifier: MIT
// Pictures and tables as files; `limitcheck reproduce` makes figures and the report of them.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

#include "bench/reproduction/reproduction.h"
#include "data/io/atomic_file.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read(const fs::path& file, const char* part) {
  std::ifstream in(file);
  if (!in)
    throw std::runtime_error(fmt::format("{} is not there: make the part '{}' first", file.string(), part));
  return Json::parse(in);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace limitcheck;
  CLI::App app{"The paper's pictures and tables from our own data, as PNG and JSON files", "reproduction"};
  fs::path folder = "build/report";
  bool quick = false;
  std::vector<std::string> parts, meshes, wanted, names = bench::picture_names();
  const std::vector<std::pair<std::string, std::function<Json()>>> tables{
      {"model", bench::model},
      {"spheres", [&] { return bench::sphere_table(quick); }},
      {"matched", [&] { return bench::matched_error_table(quick); }},
      {"timings",
       [&] {
         return bench::timings(read(folder / "spheres.json", "spheres"),
                               read(folder / "matched.json", "matched"), quick);
       }},
      {"shapes", [&] { return bench::shapes(meshes); }},
      {"maps", [&] { return bench::maps(wanted); }}};
  for (const auto& [name, table] : tables) names.push_back(name);
  app.add_option("PART", parts, "What to make; timings reads what spheres and matched have left")
      ->required()
      ->check(CLI::IsMember(names));
  app.add_option("-o,--output", folder, "Folder for the results")->capture_default_str();
  app.add_option("--mesh", meshes, "Control meshes of shapes")->allow_extra_args(false);
  app.add_option("--map", wanted, "Error maps: SUBJECT[:OPTIONS]@MESH[@DEPTH]")->allow_extra_args(false);
  app.add_flag("--quick", quick, "Fewer frames");
  CLI11_PARSE(app, argc, argv);
  const auto save = [&](const std::string& name, const Json& data) {
    data::AtomicFile file(folder / (name + ".json"));
    file.stream() << data.dump(name == "spheres" || name == "matched" || name == "timings" ? 1 : -1) << "\n";
    file.commit();
  };
  try {
    fs::create_directories(folder);
    for (const std::string& part : parts) {
      const auto table =
          std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == part; });
      if (table != tables.end())
        save(part, table->second());
      else
        bench::draw_picture(part, folder);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "reproduction: {}\n", error.what());
    return 2;
  }
  return 0;
}
