// Threads: one pool, one static partition. The same bits for any number of threads: a range's result
// may not depend on where the range is cut, and reductions are summed in a fixed order by the caller.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace ballast {

/// A fixed set of worker threads; run(task) calls task(thread) once on each of them and waits.
class ThreadPool {
public:
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return static_cast<int>(workers_.size()) + 1; }
  void run(const std::function<void(int)>& task);

private:
  void work(int thread);

  std::vector<std::thread> workers_;
  const std::function<void(int)>* task_ = nullptr;
  std::atomic<int> generation_{0};
  std::atomic<int> running_{0};
  std::atomic<bool> stop_{false};
};

/// Keeps freed memory in the process: a step's work arrays then come back without page faults. For a program's
/// main, before anything large is allocated; nothing happens where the C library has no such setting.
void keep_freed_memory();

/// Calls body(begin, end, thread) on contiguous parts of [0, count), one a thread.
template <class Body> void parallel_ranges(ThreadPool& pool, int count, Body&& body) {
  const int threads = pool.size();
  pool.run([&](int t) {
    const int begin = static_cast<int>(static_cast<long>(count) * t / threads);
    const int end = static_cast<int>(static_cast<long>(count) * (t + 1) / threads);
    if (begin < end) {
      body(begin, end, t);
    }
  });
}

/// Calls body(n) for n of [0, count); threads take turns: for work that is dear in places.
template <class Body> void parallel_turns(ThreadPool& pool, int count, Body&& body) {
  pool.run([&](int t) {
    for (int n = t; n < count; n += pool.size()) {
      body(n);
    }
  });
}

} // namespace ballast
