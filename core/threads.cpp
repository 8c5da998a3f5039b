#include "core/threads.hpp"

#include <algorithm>
#include <chrono>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace ballast {

void keep_freed_memory() {
#ifdef M_MMAP_THRESHOLD
  constexpr int largest = 1 << 30; // bytes
  mallopt(M_MMAP_THRESHOLD, largest);
  mallopt(M_TRIM_THRESHOLD, largest);
#endif
}

namespace {

/// A step's phases follow within microseconds and to wake a sleeping thread takes tens of them: a waiting thread looks again and
/// again, then lets others have the core in between, and sleeps when nothing came for as long as phases may take. Where others want
/// the core a yield costs a whole slice of theirs, milliseconds, while a sleeper that is woken has it at once: there it sleeps.
constexpr int looks = 4000, yields = 1000, calm_again = 1000; ///< the last: waits
constexpr std::chrono::microseconds long_yield{100};

void await_change(const std::atomic<int>& value, int old) {
  thread_local int crowded = 0; // waits in which not to yield
  crowded = std::max(0, crowded - 1);
  for (int look = 0; look < looks + (crowded > 0 ? 0 : yields); ++look) {
    if (value.load(std::memory_order_acquire) != old) {
      return;
    }
    if (look >= looks) {
      const auto start = std::chrono::steady_clock::now();
      std::this_thread::yield();
      if (std::chrono::steady_clock::now() - start > long_yield) {
        crowded = calm_again;
        break;
      }
    }
  }
  value.wait(old, std::memory_order_acquire);
}

} // namespace

ThreadPool::ThreadPool(int threads) {
  for (int t = 1; t < threads; ++t) {
    workers_.emplace_back([this, t] { work(t); });
  }
}

ThreadPool::~ThreadPool() {
  stop_ = true;
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  for (std::thread& worker : workers_) {
    worker.join();
  }
}

void ThreadPool::run(const std::function<void(int)>& task) {
  if (workers_.empty()) {
    task(0);
    return;
  }
  task_ = &task;
  running_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  task(0);
  for (int left = running_.load(std::memory_order_acquire); left != 0;
       left = running_.load(std::memory_order_acquire)) {
    await_change(running_, left);
  }
}

void ThreadPool::work(int thread) {
  int seen = 0;
  while (true) {
    await_change(generation_, seen);
    seen = generation_.load(std::memory_order_acquire);
    if (stop_) {
      return;
    }
    (*task_)(thread);
    running_.fetch_sub(1, std::memory_order_acq_rel);
    running_.notify_one();
  }
}

} // namespace ballast
