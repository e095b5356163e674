// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <fmt/core.h>

#include <filesystem>

#include "verify/host/isolation/worker.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw SubjectError(LC_INVALID_INPUT, why);
}

}  // namespace

const lc_subject& load_subject(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) refuse("there is no such file");
  if (!std::filesystem::is_regular_file(file, error)) refuse("this is no file");
  // A path with a slash: a bare name would be looked for where the system keeps its libraries.
  void* library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) refuse(fmt::format("cannot be loaded as a shared library: {}", dlerror()));

  using Entry = const lc_subject* (*)(std::uint32_t);
  const auto entry = reinterpret_cast<Entry>(dlsym(library, LC_SUBJECT_ENTRY));
  if (entry == nullptr)
    refuse("does not export " LC_SUBJECT_ENTRY "(); <limitcheck/subject.h> says what it must return");
  // The latest interface that both have.
  const lc_subject* subject = nullptr;
  for (std::uint32_t abi = LC_SUBJECT_ABI; abi >= 1 && subject == nullptr; --abi) subject = entry(abi);
  if (subject == nullptr)
    refuse(fmt::format("offers no interface from 1 to {}, those of this program: " LC_SUBJECT_ENTRY
                       "() is NULL for each",
                       LC_SUBJECT_ABI));
  // Some never look at the interface asked for: the table says which it is of.
  if (subject->abi < 1 || subject->abi > LC_SUBJECT_ABI)
    refuse(fmt::format("was built for interface {}, this program has {}", subject->abi, LC_SUBJECT_ABI));
  if (subject->name == nullptr || subject->capabilities == nullptr || subject->create == nullptr ||
      subject->tessellate == nullptr || subject->release == nullptr || subject->destroy == nullptr)
    refuse("the table it returns has no name, or a function of it is NULL");
  return *subject;
}

}  // namespace limitcheck::verify
