// Splits work over the machine's cores. SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace forelock::samples {

// Calls body(i) once for every i in [0, count), from several threads; returns when all are done. The body must write
// only what belongs to its own i, which is what keeps results independent of the number of threads. The first exception
// that a body throws is thrown again here.
template <typename Body>
void parallelFor(size_t count, size_t batch, const Body& body) {
  std::atomic<size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (;;) {
        const size_t first = next.fetch_add(batch);
        if (first >= count) {
          return;
        }
        const size_t last = first + batch < count ? first + batch : count;
        for (size_t i = first; i < last; ++i) {
          body(i);
        }
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) {
        failure = std::current_exception();
      }
      next = count;
    }
  };
  const size_t cores = std::thread::hardware_concurrency();
  std::vector<std::thread> helpers;
  for (size_t i = 1; i < cores && i * batch < count; ++i) {
    helpers.emplace_back(work);
  }
  work();
  for (std::thread& helper : helpers) {
    helper.join();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace forelock::samples
