// SPDX-License-Identifier: MIT
// Every subject on every mesh: who is asked when.
#include <algorithm>
#include <exception>
#include <iterator>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <system_error>
#include <thread>

#include "verify/audit/audit.h"
#include "verify/report/json.h"

namespace limitcheck::verify {

struct Auditor::Work {
  const std::vector<AuditSubject>& subjects;
  const std::vector<AuditMesh>& meshes;
  Journal* journal;
  std::vector<std::vector<Result>> results;  // of each unit
  std::map<const lc_subject*, std::mutex> asked;
  std::mutex mutex;  // of what follows, and of the journal
  std::size_t next = 0;
  std::exception_ptr error;
};

void Auditor::run_unit(Work& work, std::size_t mesh, std::size_t subject) {
  const std::size_t unit = mesh * work.subjects.size() + subject;
  const nlohmann::json* known = nullptr;
  if (work.journal != nullptr) {
    const std::scoped_lock lock(work.mutex);
    if (!work.journal->plan().has(unit)) return;
    known = work.journal->recall(unit);
  }
  work.results[unit] = known != nullptr ? rows_of(*known) : run(work.subjects[subject], work.meshes[mesh]);
  if (work.journal != nullptr && known == nullptr && !gave_up_ && lack_.empty()) {
    const std::scoped_lock lock(work.mutex);
    work.journal->keep(unit, rows_json(work.results[unit]));
  }
  const std::scoped_lock lock(shared_->mutex);
  ++shared_->done;
}

void Auditor::take_part(Work& work) try {
  for (;;) {
    std::unique_lock lock(work.mutex);
    if (work.next == work.meshes.size()) return;
    const std::size_t mesh = work.next++;
    lock.unlock();
    std::vector<std::size_t> left(work.subjects.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    while (!left.empty()) {
      std::unique_lock<std::mutex> asked;
      const auto is_free = [&](std::size_t s) {
        asked = std::unique_lock(work.asked.at(work.subjects[s].subject), std::try_to_lock);
        return asked.owns_lock();
      };
      auto next = std::find_if(left.begin(), left.end(), is_free);
      if (next == left.end()) {
        next = left.begin();
        asked = std::unique_lock(work.asked.at(work.subjects[*next].subject));
      }
      run_unit(work, mesh, *next);
      left.erase(next);
    }
  }
} catch (...) {
  const std::scoped_lock lock(work.mutex);
  if (!work.error) work.error = std::current_exception();
  work.next = work.meshes.size();
}

std::vector<Result> Auditor::run(const std::vector<AuditSubject>& subjects,
                                 const std::vector<AuditMesh>& meshes, Journal* journal) {
  // Audited mesh by mesh, so that subjects share the reference; returned subject by subject.
  const std::size_t units = subjects.size() * meshes.size();
  Work work{subjects, meshes, journal, std::vector<std::vector<Result>>(units)};
  for (const AuditSubject& s : subjects) work.asked.try_emplace(s.subject);
  shared_->done = 0;
  shared_->total = 0;
  for (std::size_t unit = 0; unit < units; ++unit)
    shared_->total += journal == nullptr || journal->plan().has(unit) ? 1 : 0;
  std::vector<std::thread> threads;
  const std::size_t workers =
      std::min({static_cast<std::size_t>(threads_), work.asked.size(), meshes.size()});
  while (threads.size() + 1 < workers) try {
      Auditor& other = *others_.emplace_back(std::make_unique<Auditor>(depth_, threads_, nullptr, level_));
      other.shared_ = shared_, other.leaves_ = leaves_;
      threads.emplace_back([&work, &other] { other.take_part(work); });
    } catch (const std::system_error&) {  // there are no more threads to be had
      break;
    }
  take_part(work);
  for (std::thread& thread : threads) thread.join();
  for (const auto& other : others_) {
    gave_up_ = gave_up_ || other->gave_up_;
    abandoned_ = abandoned_ || other->abandoned_;
    if (lack_.empty()) lack_ = other->lack_;
  }
  if (!abandoned_) others_.clear();
  if (work.error) std::rethrow_exception(work.error);
  std::vector<Result> all;
  for (std::size_t s = 0; s < subjects.size(); ++s)
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      auto& results = work.results[m * subjects.size() + s];
      all.insert(all.end(), std::make_move_iterator(results.begin()), std::make_move_iterator(results.end()));
    }
  shared_->total = 1;
  shared_->done = 0;
  return all;
}

}  // namespace limitcheck::verify
