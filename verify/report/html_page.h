// SPDX-License-Identifier: MIT
#pragma once

namespace limitcheck::verify {

/// html/page.html, with %DATA% where the report goes.
extern const char* const kHtmlPage;

}  // namespace limitcheck::verify
