#pragma once

#include <atomic>
#include <cstddef>

namespace nda::pipeline {

/// Threads that Options::num_threads stands for: never more than the machine has cores; 0: as many.
int num_workers(int num_threads);

/// Calls call(context, i, worker) for every i < count on up to num_workers(num_threads) threads,
/// the numbers handed out one by one, in ascending order; worker < num_workers(num_threads) names
/// the thread.  Returns when all calls have.  The first exception that a call throws is thrown on,
/// and the calls that have not begun by then are left out.  Calls may call for_all: what that hands
/// out goes to the threads that have run out of calls.
void for_all(std::size_t count,
             int num_threads,
             void* context,
             void (*call)(void* context, std::size_t i, std::size_t worker));

/// The same with any work(i, worker).
///
/// Its two atomics say over again what for_all promises: each call sees what was written before
/// for_all, and what a call wrote, an exception included, is seen after it.  The thread sanitizer
/// needs that told, since it cannot look into Debian's oneTBB.
template <typename Work>
void for_all(std::size_t count, int num_threads, Work&& work) {
  struct Job {
    std::atomic<bool> begun;
    Work& work;
    std::atomic<std::size_t> ended;
    ~Job() { ended.load(std::memory_order_acquire); }
  } job{false, work, 0};
  struct Call {
    Job& job;
    explicit Call(Job& of) : job(of) { job.begun.load(std::memory_order_acquire); }
    ~Call() { job.ended.fetch_add(1, std::memory_order_release); }
  };
  job.begun.store(true, std::memory_order_release);
  for_all(count, num_threads, &job, [](void* context, std::size_t i, std::size_t worker) {
    const Call call(*static_cast<Job*>(context));
    call.job.work(i, worker);
  });
}

}  // namespace nda::pipeline
