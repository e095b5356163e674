// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "verify/gl/guard_zone.h"
#include "verify/gl/vulkan.h"
#include "verify/shader/programs.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

namespace {

// As much of a module as says whether it can be run as it is meant.
struct Module {
  VulkanDevice::Code code;
  std::string entry;
  std::int64_t group = 0;

  // bindings: those that there are
  Module(const std::string& file, const std::set<std::uint32_t>& bindings) {
    const auto refuse = [&](const std::string& why) {
      throw SubjectError(LC_INVALID_INPUT, fmt::format("{}: {}", file, why));
    };
    std::string content;
    try {
      content = data::io::whole_content(file);
    } catch (const data::Error& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
    code.resize(content.size() / 4);
    std::memcpy(code.data(), content.data(), 4 * code.size());
    if (content.size() % 4 != 0 || code.size() < 5 || code[0] != 0x07230203)
      refuse("it is no module of SPIR-V");
    // Words 1 to 5 behind the one that says what an instruction is and how long.
    constexpr std::uint32_t kEntryPoint = 15, kExecutionMode = 16, kDecorate = 71;
    constexpr std::uint32_t kCompute = 5, kLocalSize = 17, kBinding = 33, kSet = 34;
    for (std::size_t at = 5, length = 0; at < code.size(); at += length) {
      const std::uint32_t* const word = &code[at];
      length = word[0] >> 16;
      if (length == 0 || length > code.size() - at)
        refuse("it is no module of SPIR-V: an instruction is cut");
      const std::uint32_t is = word[0] & 0xFFFF;
      if (is == kEntryPoint && length > 3) {
        if (!entry.empty()) refuse("it has more than one entry point");
        if (word[1] != kCompute) refuse("its entry point is no compute shader");
        const char* const name = reinterpret_cast<const char*>(word + 3);
        entry.assign(name, strnlen(name, 4 * (length - 3)));
      } else if (is == kExecutionMode && length == 6 && word[2] == kLocalSize) {
        if (word[4] != 1 || word[5] != 1) refuse("its work groups have more than one dimension");
        group = word[3];
      } else if (is == kDecorate && length == 4 && word[2] == kSet && word[3] != 0) {
        refuse("it has a descriptor set besides set 0");
      } else if (is == kDecorate && length == 4 && word[2] == kBinding && !bindings.contains(word[3])) {
        refuse(fmt::format("it uses binding {0}; there are {1}, and those of `buffer {0} BYTES` in {2}",
                           word[3], fmt::join(bindings, ", "), "its pragmas"));
      }
    }
    if (entry.empty() || group == 0) refuse("it has no entry point, or no LocalSize in numbers");
  }
};

// There until the process ends, as its driver is.
const VulkanDevice& the_device() {
  static const auto& device = *new VulkanDevice;
  return device;
}

class SpirvPrograms : public ComputePrograms {
 public:
  explicit SpirvPrograms(const ShaderSource& source) {
    std::set<std::uint32_t> bindings{0, 1};
    for (const ShaderSource::Buffer& b : source.buffers)
      bindings.insert(static_cast<std::uint32_t>(b.binding));
    const std::filesystem::path file(source.file);
    if (source.passes.empty()) modules_.emplace_back(file, bindings);
    for (const ShaderSource::Pass& pass : source.passes)
      modules_.emplace_back(std::filesystem::path(file).replace_extension(pass.name + ".spv"), bindings);
  }
  const std::string& device() const override { return the_device().name(); }
  std::int64_t most_bytes_of_a_buffer() const override { return the_device().most_bytes_of_a_buffer(); }

  void run(std::span<const ComputeStep> steps, std::vector<ComputeBuffer>& buffers) const override {
    std::vector<VulkanDevice::Dispatch> dispatches;
    for (const ComputeStep& step : steps) {
      const Module& m = modules_[step.program];
      dispatches.push_back({m.code, m.entry.c_str(), (step.items + m.group - 1) / m.group, step.parameters});
    }
    std::vector<VulkanDevice::Buffer> there;
    for (ComputeBuffer& b : buffers) {
      add_guard(b.content);
      there.push_back({b.binding, std::move(b.content)});
    }
    the_device().run(dispatches, there);
    for (std::size_t k = 0; k < buffers.size(); ++k) {
      buffers[k].content = std::move(there[k].content);
      cut_guard(buffers[k].content, buffers[k].size);
    }
  }

 private:
  std::vector<Module> modules_;
};

}  // namespace

std::unique_ptr<ComputePrograms> spirv_programs(const ShaderSource& source) try {
  auto programs = std::make_unique<SpirvPrograms>(source);
  (void)the_device();
  return programs;
} catch (const SubjectError&) {
  throw;
} catch (const std::runtime_error& error) {
  throw SubjectError(LC_INVALID_INPUT, fmt::format("no Vulkan here: {}", error.what()));
}

}  // namespace limitcheck::verify
