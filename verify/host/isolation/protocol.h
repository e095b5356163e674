// SPDX-License-Identifier: MIT
// The line protocol between the host and a subject in a process of its own: what PROTOCOL.md beside this file
// says, as functions. No processes here: answers are read from any source of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "verify/subject/subject.h"

namespace limitcheck::verify::protocol {

inline constexpr int kVersion = 2;  // the latest; programs of version 1 are still understood
inline constexpr std::size_t kLongestHeader = std::size_t{64} << 10;
inline constexpr std::size_t kLongestLine = 1024;  // of a text payload

/// The bytes are no valid answer. what() says what came instead.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where the bytes of an answer come from. Both throw if they end too early.
class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;
  /// Exactly so many bytes.
  virtual void read(std::span<std::byte> to) = 0;
  /// Up to the line end, which is taken and not returned.
  /// Throws Error if there is none within `longest` bytes.
  virtual std::string line(std::size_t longest) = 0;
};

enum class Payload { kBinary, kText };

/// What a subject says about itself.
struct Capabilities {
  lc_capabilities values{};
  Payload payload = Payload::kBinary;  // of everything after this answer, both ways
  int version = kVersion;              // likewise
  std::string options;                 // what options it takes, in words; may be empty
  std::string device;                  // what it computes on besides the processor; may be empty
};

/// Requests, ready to be sent.
std::string ask_capabilities(const std::string& options, lc_scheme scheme);
std::string ask_create(const lc_mesh& mesh, const std::string& options, const Capabilities& capabilities);
std::string ask_tessellate(std::span<const std::int32_t> face_depth, int threads,
                           const Capabilities& capabilities);
/// Of the worker only: destroy(), and to end.
std::string ask_end();

/// Answers. All throw Error, SubjectError if the subject refuses, or std::bad_alloc if this program has no
/// memory for what is delivered.
Capabilities read_capabilities(Source& source);
void read_created(Source& source);
/// Of the worker only: the exit status it is going to end with.
int read_ended(Source& source);

/// Allocates the arrays from `request`, reads them and announces them in `out`.
///   most_bytes   an answer that announces more is refused before anything is allocated
///   mesh         that was handed over, whose channels come with it
void read_tessellation(Source& source, const Capabilities& capabilities, std::uint64_t most_bytes,
                       const lc_mesh& mesh, const lc_request& request, lc_tessellation& out);

/// The same from the worker (worker.h), which tells more than a program: repeats in the memory of `request` all that the
/// subject did in the worker's: every block with its contents, writes into the guard zones, where each array points, and in
/// `mesh` what the subject wrote to it. So the host judges what it would have seen without the process in between. Returns
/// whether release() threw there.
bool read_replay(Source& source, std::uint64_t most_bytes, const lc_mesh& mesh, const lc_request& request,
                 lc_tessellation& out);

/// A text for a message: at most `longest` bytes, nothing a terminal would act on.
std::string printable(std::string_view text, std::size_t longest);

}  // namespace limitcheck::verify::protocol
