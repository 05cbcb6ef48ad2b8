#include "solve/parallel.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>

// The one file that knows oneTBB, compiled without the thread sanitizer (see CMakeLists.txt here):
// the library itself is not instrumented, so that the half of it that stands in its headers would
// seem to race with the other half.  Hence it takes a plain function and shares no other code.

namespace nda::pipeline {

namespace {

// Whether this thread is at work on calls already.  Calls within calls are shared with those
// threads that have nothing else to do, and a thread that waits for them takes up no other work.
struct Within {
  Within() { is_within = true; }
  ~Within() { is_within = before; }

  static thread_local bool is_within;
  const bool before = is_within;
};

thread_local bool Within::is_within = false;

}  // namespace

// One thread, the default, must not cost the start of oneTBB.  More threads than cores would gain
// nothing, and oneTBB would say so on standard error.
int num_workers(int num_threads) {
  if (num_threads == 1) return 1;
  const int most = tbb::info::default_concurrency();
  return num_threads == 0 || num_threads > most ? most : num_threads;
}

void for_all(std::size_t count,
             int num_threads,
             void* context,
             void (*call)(void* context, std::size_t i, std::size_t worker)) {
  if (num_threads == 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) call(context, i, 0);
    return;
  }
  std::atomic<std::size_t> next = 0;
  const auto work = [&](int) {
    const Within within;
    const auto worker = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
    try {
      for (;;) {
        const std::size_t i = next.fetch_add(1);
        if (i >= count) return;
        call(context, i, worker);
      }
    } catch (...) {
      next.store(count);
      throw;
    }
  };
  const int workers = num_workers(num_threads);
  const auto share = [&] { tbb::parallel_for(0, workers, 1, work, tbb::simple_partitioner()); };
  if (Within::is_within)
    tbb::this_task_arena::isolate(share);
  else
    tbb::task_arena(workers).execute(share);
}

}  // namespace nda::pipeline
