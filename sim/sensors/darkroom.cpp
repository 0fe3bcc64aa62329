#include "sim/sensors/darkroom.h"

#include <chrono>
#include <utility>

namespace alula::sim {

class Darkroom::Print {
 public:
  Job job;
  Developed result;
  std::exception_ptr failure;
  bool done = false;
};

Darkroom::Darkroom(std::vector<render::CameraRenderer*> renderers, bool threads) : renderers_(std::move(renderers)) {
  if (!threads) return;
  for (render::CameraRenderer* renderer : renderers_) {
    threads_.emplace_back([this, renderer] { Work(*renderer); });
  }
}

Darkroom::~Darkroom() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

std::shared_ptr<Darkroom::Print> Darkroom::Request(Job job) {
  auto print = std::make_shared<Print>();
  print->job = std::move(job);
  if (threads_.empty()) return print;
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(print);
  }
  changed_.notify_all();
  return print;
}

Developed Darkroom::Fetch(const std::shared_ptr<Print>& print) {
  if (threads_.empty()) {
    if (!print->done) Develop(*print, *renderers_.front());
  } else {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&print] { return print->done; });
  }
  if (print->failure) std::rethrow_exception(print->failure);
  return print->result;
}

double Darkroom::wall_ms() const {
  const std::lock_guard lock(mutex_);
  return wall_ms_;
}

void Darkroom::Develop(Print& print, render::CameraRenderer& renderer) {
  const auto begin = std::chrono::steady_clock::now();  // for timing.json only
  Developed result;
  std::exception_ptr failure;
  try {
    result = print.job(renderer);
  } catch (...) {
    failure = std::current_exception();
  }
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  const std::lock_guard lock(mutex_);
  print.result = std::move(result);
  print.failure = failure;
  print.done = true;
  print.job = nullptr;
  wall_ms_ += spent.count();
}

void Darkroom::Work(render::CameraRenderer& renderer) {
  for (;;) {
    std::shared_ptr<Print> print;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || !queue_.empty(); });
      if (stop_) return;
      print = std::move(queue_.front());
      queue_.pop_front();
    }
    Develop(*print, renderer);
    changed_.notify_all();
  }
}

}  // namespace alula::sim
