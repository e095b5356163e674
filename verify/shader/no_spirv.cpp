// SPDX-License-Identifier: MIT
#include "verify/shader/programs.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

std::unique_ptr<ComputePrograms> spirv_programs(const ShaderSource& source) {
  throw SubjectError(LC_INVALID_INPUT, source.file +
                                           ": this limitcheck was built without Vulkan (Debian packages "
                                           "libvulkan-dev and mesa-vulkan-drivers)");
}

}  // namespace limitcheck::verify
