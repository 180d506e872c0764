#include "physics_node/loop/eye_sender.h"

#include <chrono>

#include "common/report/log.h"

namespace palpate::physics {
namespace {

constexpr auto again_period = std::chrono::milliseconds(33);
constexpr int most_refusals =
    100;  // of one chunk: some 20 s, by when DDS has given up a reader that does not answer

}  // namespace

EyeSender::EyeSender(Participant& participant, bool repeat)
    : surfaces_(participant), blocks_(participant), repeat_(repeat), thread_([this] { send(); }) {}

EyeSender::~EyeSender() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  something_.notify_one();
  thread_.join();
}

void EyeSender::post(const BodySurface& chunk) {
  const std::lock_guard lock(mutex_);
  const auto outdated = [&](const auto& due) {
    return due.first.first == chunk.body && due.second->revision < chunk.revision;
  };
  std::erase_if(surfaces_due_, outdated);
  std::erase_if(blocks_due_, outdated);
  std::erase_if(sent_, outdated);
  surfaces_due_[{chunk.body, chunk.chunk}] = std::make_unique<BodySurface>(chunk);
  something_.notify_one();
}

void EyeSender::post(const VertexBlock& block) {
  const std::lock_guard lock(mutex_);
  auto& due = blocks_due_[{block.body, block.block}];
  if (due)
    *due = block;
  else
    due = std::make_unique<VertexBlock>(block);
  something_.notify_one();
}

void EyeSender::send() {
  std::unique_lock lock(mutex_);
  auto next_again = std::chrono::steady_clock::now();
  while (!end_) {
    if (!surfaces_due_.empty()) {
      send_surface(lock);
    } else if (!blocks_due_.empty()) {
      send_block(lock);
    } else {
      something_.wait_for(lock, again_period);
    }
    if (!repeat_ || std::chrono::steady_clock::now() < next_again) continue;
    send_again(lock);
    next_again = std::chrono::steady_clock::now() + again_period;
  }
}

/// The lock is open while DDS works. A chunk that DDS could not take comes again unless a newer one has come.
void EyeSender::send_surface(std::unique_lock<std::mutex>& lock) {
  auto node = surfaces_due_.extract(surfaces_due_.begin());
  const std::uint32_t body = node.key().first;
  lock.unlock();
  const bool sent = surfaces_.write(*node.mapped());
  lock.lock();
  refusals_ = sent ? 0 : refusals_ + 1;
  if (sent) return;
  if (refusals_ >= most_refusals) {
    log_warn("a part of the surface of body {} could not be sent and is left out", body);
    refusals_ = 0;
    return;
  }
  const auto newer = surfaces_due_.lower_bound({body, 0});
  if (newer == surfaces_due_.end() || newer->first.first != body ||
      newer->second->revision == node.mapped()->revision)
    surfaces_due_.insert(std::move(node));
}

void EyeSender::send_block(std::unique_lock<std::mutex>& lock) {
  auto node = blocks_due_.extract(blocks_due_.begin());
  lock.unlock();
  blocks_.write(*node.mapped());
  lock.lock();
  if (repeat_) sent_[node.key()] = std::move(node.mapped());
}

void EyeSender::send_again(std::unique_lock<std::mutex>& lock) {
  if (sent_.empty()) return;
  auto at = sent_.upper_bound(last_again_);
  if (at == sent_.end()) at = sent_.begin();
  last_again_ = at->first;
  auto node = sent_.extract(at);
  lock.unlock();
  blocks_.write(*node.mapped());
  lock.lock();
  sent_.insert(std::move(node));
}

}  // namespace palpate::physics
