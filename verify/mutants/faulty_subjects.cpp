// SPDX-License-Identifier: MIT
#include "verify/mutants/faulty_subjects.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "verify/host/host.h"
#include "verify/mutants/planted_faults.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

class FaultySubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    const Inner inner(options);
    return verify::capabilities(inner.subject, inner.options);
  }

  FaultySubject(const lc_mesh& mesh, Options& options) : FaultySubject(mesh, Inner(options)) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    if (session_.capabilities().precision == LC_FLOAT32) {
      run<float>(request, out);
    } else {
      run<double>(request, out);
    }
  }

  static std::vector<std::string_view> names() {
    std::vector<std::string_view> names;
    for (const auto& entry : planted_faults<double>()) names.push_back(entry.fault.name);
    return names;
  }

 private:
  // What the options say: the fault, the subject it is planted in, and the options for that one.
  struct Inner {
    explicit Inner(Options& given)
        : fault(static_cast<std::size_t>(given.choice("fault", names()))),
          subject(find(given.value("of", "null"))),
          options(given.rest()) {}

    static const lc_subject& find(const std::string& name) {
      const lc_subject* subject = find_subject(name);
      if (subject == nullptr || subject == lc_subject_faulty()) {
        throw SubjectError(LC_INVALID_INPUT, fmt::format("option of={}: there is no such subject", name));
      }
      return *subject;
    }

    std::size_t fault;
    const lc_subject& subject;
    std::string options;
  };

  FaultySubject(const lc_mesh& mesh, const Inner& inner)
      : lent_(mesh), fault_(inner.fault), session_(inner.subject, taken(mesh, inner.fault), inner.options) {}

  static data::ControlMesh taken(const lc_mesh& mesh, std::size_t fault) {
    data::ControlMesh result = control_mesh(mesh);
    if (const auto take = planted_faults<double>()[fault].take) take(result);
    return result;
  }

  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) {
    const std::span depth(request.face_depth, static_cast<std::size_t>(lent_.triangle_count));
    const Tessellation good = session_.tessellate(depth, request.threads);
    Copy<Real> copy{copy_of<Real>(good)};
    copy.face_depth.assign(depth.begin(), depth.end());
    planted_faults<Real>()[fault_].plant(session_.mesh(), copy);
    deliver(copy, request, out);
  }

  template <class Real>
  void deliver(const Copy<Real>& copy, const lc_request& request, lc_tessellation& out) {
    const auto output =
        allocate_output<Real>(request, out, static_cast<std::int64_t>(copy.positions.size()),
                              static_cast<std::int64_t>(copy.triangles.size()), !copy.normals.empty());
    fill(output, copy);

    if (copy.overrun) output.positions[3 * copy.positions.size()] = Real(1);
    if (copy.underrun) output.positions[-1] = Real(1);
    if (copy.modify_mesh) const_cast<double*>(lent_.positions)[0] += 1;
    out.vertex_count = copy.announced_vertices.value_or(out.vertex_count);
    if (copy.overlap) out.normals = out.positions;
    if (copy.foreign_normals) {
      elsewhere_.assign(3 * sizeof(Real) * copy.positions.size() + sizeof(Real), 0);
      out.normals = elsewhere_.data();
    }
  }

  const lc_mesh lent_;
  const std::size_t fault_;
  Session session_;
  std::vector<unsigned char> elsewhere_;
};

}  // namespace

std::span<const Fault> faults() {
  static const std::vector<Fault> list = [] {
    std::vector<Fault> result;
    for (const auto& entry : planted_faults<double>()) result.push_back(entry.fault);
    return result;
  }();
  return list;
}

std::string faulty_options(std::string_view fault, std::string_view subject, std::string_view options) {
  return fmt::format("fault={},of={}{}{}", fault, subject, options.empty() ? "" : ",", options);
}

}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_faulty() {
  using limitcheck::verify::FaultySubject;
  static const lc_subject subject = limitcheck::verify::make_subject<FaultySubject>(
      "faulty", "another subject with a fault planted: what a check must fail on",
      "of=SUBJECT, fault=NAME (default none), and the options of that subject");
  return &subject;
}
