#include "sim/sensors/image_taker.h"

#include <chrono>
#include <utility>

namespace alula::sim {

ImageTaker::ImageTaker(const StereoCameraConfig& config, std::uint64_t seed, const std::string& vehicle,
                       render::CameraRenderer& renderer, bool own_thread)
    : config_(config), seed_(seed), names_{vehicle + "/camera.left", vehicle + "/camera.right"}, renderer_(renderer) {
  if (own_thread) thread_ = std::thread([this] { Work(); });
}

ImageTaker::~ImageTaker() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ImageTaker::Request(std::uint32_t seq, base::Time captured, const base::Transform& X_WB) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back({seq, captured, X_WB});
  }
  changed_.notify_all();
}

std::array<stack::Image, 2> ImageTaker::Fetch() {
  if (!thread_.joinable()) {
    const Shot shot = requests_.front();
    requests_.pop_front();
    return Draw(shot);
  }
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !done_.empty() || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  std::array<stack::Image, 2> pair = std::move(done_.front());
  done_.pop_front();
  return pair;
}

double ImageTaker::wall_ms() const {
  const std::lock_guard lock(mutex_);
  return wall_ms_;
}

std::array<stack::Image, 2> ImageTaker::Draw(const Shot& shot) {
  const auto begin = std::chrono::steady_clock::now();  // for timing.json only
  std::array<stack::Image, 2> pair;
  for (int eye = 0; eye < 2; ++eye) {
    pair[eye] = TakeImage(config_, eye, shot.X_WB, shot.captured, shot.seq, seed_, names_[eye], renderer_);
  }
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  const std::lock_guard lock(mutex_);
  wall_ms_ += spent.count();
  return pair;
}

void ImageTaker::Work() {
  for (;;) {
    Shot shot;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || !requests_.empty(); });
      if (stop_) return;
      shot = requests_.front();
      requests_.pop_front();
    }
    try {
      std::array<stack::Image, 2> pair = Draw(shot);
      const std::lock_guard lock(mutex_);
      done_.push_back(std::move(pair));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
    changed_.notify_all();
  }
}

}  // namespace alula::sim
