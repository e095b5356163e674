// SPDX-License-Identifier: MIT
// Text that somebody else wrote, at the outputs of this program: names of files, messages of subjects, what they print.
#pragma once

#include <string>
#include <string_view>

namespace limitcheck::verify {

/// The text as it may go to a terminal or into XML: valid UTF-8 without control characters but new line and tab.
/// These, DEL too, become their pictures (ESC is U+241B); each byte that is no UTF-8, or is of a lone surrogate, of
/// U+0080 to U+009F or of a noncharacter (U+FFFE), becomes U+FFFD. All else stays as it is.
std::string visible_text(std::string_view text);

}  // namespace limitcheck::verify
