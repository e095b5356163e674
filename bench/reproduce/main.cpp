// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>

#include "bench/reproduce/reproduce.h"
#include "verify/mesh_output/atomic_file.h"

int main(int argc, char** argv) {
  CLI::App app{"limitcheck reproduce: the paper's tables and figures from our own data",
               "limitcheck reproduce"};
  std::filesystem::path folder = "build/report";
  app.add_option("-o,--output", folder, "Folder for the results")->capture_default_str();
  bool quick = false;
  app.add_flag("--quick", quick, "Fewer frames");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(folder);
    limitcheck::bench::draw_pictures(folder);
    limitcheck::verify::AtomicFile file(folder / "spheres.json");
    file.stream() << limitcheck::bench::sphere_table(quick).dump(1) << "\n";
    file.commit();
    fmt::print("{}\n", (folder / "spheres.json").string());
  } catch (const std::exception& error) {
    fmt::print(stderr, "limitcheck reproduce: {}\n", error.what());
    return 2;
  }
  return 0;
}
