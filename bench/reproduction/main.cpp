// SPDX-License-Identifier: MIT
// Pictures and tables as files; `limitcheck reproduce` makes figures and the report of them.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>

#include "bench/reproduction/reproduction.h"
#include "verify/mesh_output/atomic_file.h"

int main(int argc, char** argv) {
  using namespace limitcheck;
  namespace fs = std::filesystem;
  CLI::App app{"The paper's pictures and tables from our own data, as PNG and JSON files", "reproduction"};
  fs::path folder = "build/report";
  bool quick = false;
  app.add_option("-o,--output", folder, "Folder for the results")->capture_default_str();
  app.add_flag("--quick", quick, "Fewer frames");
  CLI11_PARSE(app, argc, argv);
  const auto save = [&](const char* name, const nlohmann::ordered_json& data) {
    verify::AtomicFile file(folder / name);
    file.stream() << data.dump(1) << "\n";
    file.commit();
    fmt::print("{}\n", (folder / name).string());
  };
  try {
    fs::create_directories(folder);
    bench::draw_pictures(folder);
    save("model.json", bench::model());
    const auto spheres = bench::sphere_table(quick);
    save("spheres.json", spheres);
    save("trends.json", bench::check_trends(spheres, quick));
  } catch (const std::exception& error) {
    fmt::print(stderr, "reproduction: {}\n", error.what());
    return 2;
  }
  return 0;
}
