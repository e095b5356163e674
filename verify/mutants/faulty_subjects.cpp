// SPDX-License-Identifier: MIT
#include "verify/mutants/faulty_subjects.h"

#include <fmt/core.h>

#include <algorithm>
#include <future>
#include <iterator>
#include <map>
#include <memory>
#include <new>
#include <utility>

#include "verify/mutants/change_rows.h"
#include "verify/subject/adapter.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using FaceDepths = std::vector<std::int32_t>;

constexpr const char *kFault = "fault", *kHabit = "habit";

// What all instances share, as what is kept in a static variable would be. The last instance empties it, as the
// end of a process would.
struct Memory {
  Memory() { ++instances; }
  ~Memory() {
    if (--instances > 0) return;
    seen.clear();
    last = {};
    first_most = 0;
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  inline static int instances = 0, calls = 0, first_most = 0;
  inline static std::vector<std::pair<data::ControlMesh, data::ControlMesh>> seen;  // what was not forgotten
  inline static data::ControlMesh last;
};

// The first mesh that is the same but for what is forgotten.
data::ControlMesh first_like(const data::ControlMesh& mesh, const Change& change) {
  data::ControlMesh key = mesh;
  change.forget(key);
  for (const auto& [other, first] : Memory::seen)
    if (other == key) return first;
  Memory::seen.emplace_back(std::move(key), mesh);
  return mesh;
}

// Where memory comes from that is handed out as parts of one block of the host's: the arrays lie in it from the last to
// the first, with room between, and it begins and ends with something else.
struct OneBlock {
  static constexpr std::size_t kRoom = 64, kArrays = 6;

  OneBlock(const lc_request& request, std::size_t bytes_of_arrays) : parts(request) {
    const std::size_t bytes = (bytes_of_arrays / kRoom + 2 * kArrays + 2) * kRoom;
    (void)request.allocate(request.host, 0);
    end = static_cast<char*>(request.allocate(request.host, bytes));
    if (end == nullptr) throw std::bad_alloc();
    end += bytes;
    parts.host = this;
    parts.allocate = [](void* host, std::size_t size) -> void* {
      return static_cast<OneBlock*>(host)->end -= (size / kRoom + 2) * kRoom;
    };
  }

  char* end;
  lc_request parts;
};

// `faulty`, whose option chooses from the tables of faults, or `unusual`, from the habits.
template <bool kFaulty>
class ChangedSubject {
 public:
  static constexpr bool kLeavesRefusals = true;  // to the subject that is changed

  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    return Choice(options).declared(scheme_of(scheme));
  }

  ChangedSubject(const lc_mesh& mesh, Options& options)
      : choice_(options),
        lent_(mesh),
        lent_at_(&mesh),
        scheme_(scheme_of(mesh.scheme)),
        mesh_(control_mesh(mesh)) {
    behave();
    declared_ = choice_.declared(scheme_);
    if (change().take) change().take(mesh_);
    try {
      session_ = session(mesh_);  // refuses what it refuses
    } catch (const SubjectError& error) {
      if (!change().deaf || error.status() != LC_INVALID_INPUT) throw;
      return;
    }
    if (mesh_.faces.empty()) throw SubjectError(LC_INVALID_INPUT, "the mesh has no faces");
    if (change().refuse) change().refuse(Asked(mesh_, scheme_, 0));
    known_ = mesh_;
    if (change().forget) {
      known_ = first_like(mesh_, change());
      if (!change().remake && !(known_ == mesh_)) {
        mesh_ = known_;
        session_ = session(mesh_);
      }
    }
    Memory::last = mesh_;
    if (Memory::first_most == 0) Memory::first_most = Asked(mesh_, scheme_, 0).most_faces();
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    behave();
    Delivered copy;
    if (session_ && change().in_a_thread)
      copy = std::async(std::launch::async, [&] { return changed(request); }).get();
    else if (session_)
      copy = changed(request);
    declared_.precision == LC_FLOAT32 ? hand_over<float>(copy, request, out)
                                      : hand_over<double>(copy, request, out);
  }

 private:
  // What the options say: the row of the table, the subject that is changed, and the options for that one.
  struct Choice {
    explicit Choice(Options& given) {
      const std::span<const Change> rows = kFaulty ? all_faults() : habits();
      std::vector<std::string_view> names;
      for (const Change& c : rows) names.push_back(c.name);
      change = &rows[static_cast<std::size_t>(given.choice(kFaulty ? kFault : kHabit, names))];
      const std::string name = given.value("of", "null");
      subject = find_subject(name);
      if (subject == nullptr || subject == lc_subject_faulty() || subject == lc_subject_unusual())
        throw SubjectError(LC_INVALID_INPUT, fmt::format("option of={}: there is no such subject", name));
      options = given.rest();
    }
    lc_capabilities declared(data::Scheme scheme) const {
      lc_capabilities c = verify::capabilities(*subject, options, scheme);
      if (change->declare) change->declare(c);
      if (change->on == Change::On::kLoop) c.schemes = LC_DOES_LOOP;
      if (change->on == Change::On::kQuads) c.schemes = LC_DOES_CATMULL_CLARK;
      return c;
    }
    const Change* change;
    const lc_subject* subject;
    std::string options;
  };

  const Change& change() const { return *choice_.change; }
  void behave() const {
    if (change().behave) change().behave();
  }
  std::unique_ptr<Session> session(const data::ControlMesh& mesh) const {
    const bool validates = declared_.does_not_validate == 0;
    return std::make_unique<Session>(*choice_.subject, mesh, choice_.options,
                                     validates ? Session::Input::kAsItIs : Session::Input::kValid, scheme_);
  }

  // What the sound subject delivers for this request, changed.
  Delivered changed(const lc_request& request) {
    FaceDepths depth(request.face_depth, request.face_depth + mesh_.faces.size());
    Asked asked(mesh_, scheme_, std::max(0, *std::max_element(depth.begin(), depth.end())));
    asked.threads = request.threads;
    asked.call = ++calls_, asked.call_of_all = ++Memory::calls;
    asked.lent = lent_at_;
    asked.known = &known_, asked.last = &Memory::last;
    asked.first_most = Memory::first_most;
    asked.first_as_deep = first_as_deep_.try_emplace(asked.deepest, depth).first->second;
    if (calls_ == 1) first_depths_ = depth;
    asked.first_depths = first_depths_;
    asked.again = [&](const data::ControlMesh& mesh, const FaceDepths& depths) {
      return Delivered(session(mesh)->tessellate(depths, request.threads));
    };
    if (change().ask) change().ask(asked, depth);
    asked.depth = depth;
    Delivered copy;
    if (change().remake) {
      data::ControlMesh other = mesh_;
      change().remake(asked, other);
      copy = asked.again(other, depth);
    } else {
      copy = Delivered(session_->tessellate(depth, request.threads));
    }
    copy.single = declared_.precision == LC_FLOAT32;
    if (declared_.normals == 0) copy.normals.clear();
    if (change().deliver) change().deliver(asked, copy);
    return copy;
  }

  template <class Real>
  void hand_over(const Delivered& copy, const lc_request& request, lc_tessellation& out) {
    const std::size_t vertices = copy.positions.size(), triangles = copy.triangles.size();
    const auto allocate = [&](const lc_request& from) {
      return allocate_output<Real>(
          from, out, static_cast<std::int64_t>(vertices), static_cast<std::int64_t>(triangles),
          !copy.normals.empty() || (vertices == 0 && declared_.normals != 0), !copy.corner.empty());
    };
    constexpr std::size_t kVertex = 6 * sizeof(Real) + sizeof(lc_provenance) + sizeof(std::int32_t);
    constexpr std::size_t kTriangle = 3 * sizeof(std::uint32_t) + sizeof(std::int32_t);
    const auto output = copy.in_one_block
                            ? allocate(OneBlock(request, vertices * kVertex + triangles * kTriangle).parts)
                            : allocate(request);
    copy.write(output);
    // Triangles that were added or left out have no channel values: then none are delivered.
    const std::size_t values = 3 * triangles * components_of_channels(lent_);
    const auto put = [&](const std::vector<double>& numbers, std::size_t count, auto array) {
      if (numbers.empty() || numbers.size() != count) return;
      Real* to = allocate_channels<Real>(request, lent_, out, array);
      for (const double x : numbers) *to++ = static_cast<Real>(x);
    };
    put(copy.channel_values, values, &lc_tessellation::channel_values);
    put(copy.channel_derivatives, 2 * values, &lc_tessellation::channel_derivatives);
    if (copy.overrun) output.positions[3 * vertices] = Real(1);
    if (copy.underrun) output.positions[-1] = Real(1);
    if (copy.modify_mesh) const_cast<double*>(lent_.positions)[0] += 1;
    out.vertex_count = copy.announced_vertices.value_or(out.vertex_count);
    if (copy.overlap) out.normals = out.positions;
    if (copy.foreign_normals) {
      elsewhere_.assign(3 * sizeof(Real) * vertices + sizeof(Real), 0);
      out.normals = elsewhere_.data();
    }
  }

  const Choice choice_;
  const lc_mesh lent_;
  const lc_mesh* const lent_at_;
  const data::Scheme scheme_;
  data::ControlMesh mesh_, known_;
  lc_capabilities declared_{};
  const Memory memory_;
  std::unique_ptr<Session> session_;
  int calls_ = 0;
  FaceDepths first_depths_;
  std::map<int, FaceDepths> first_as_deep_;
  std::vector<unsigned char> elsewhere_;
};

}  // namespace

std::span<const Fault> all_faults() {
  static const Rows list = [] {
    Rows to;
    to.assign(faults().begin(), faults().end());
    for (const auto& add_to : {faults_of_frames, faults_of_numbers, faults_of_refusals, faults_of_memory,
                               faults_of_polygons, faults_of_tags, faults_of_sharp_rules, faults_of_rare_tags,
                               faults_of_rare_places, faults_of_channels, faults_of_channel_derivatives})
      add_to(to);
    return to;
  }();
  return list;
}

std::string faulty_options(std::string_view fault, std::string_view subject, std::string_view options) {
  return fmt::format("{}={},of={}{}{}", kFault, fault, subject, options.empty() ? "" : ",", options);
}

}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_faulty() {
  using namespace limitcheck::verify;
  static const lc_subject subject = make_subject<ChangedSubject<true>>(
      "faulty", "another subject with a fault planted: what a check must fail on",
      "of=SUBJECT, fault=NAME (default none), and the options of that subject");
  return &subject;
}

extern "C" const lc_subject* lc_subject_unusual() {
  using namespace limitcheck::verify;
  static const lc_subject subject = make_subject<ChangedSubject<false>>(
      "unusual", "another subject with a habit that is rare and right: what no check may blame",
      "of=SUBJECT, habit=NAME (default none), and the options of that subject");
  return &subject;
}
