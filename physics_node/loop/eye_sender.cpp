#include "physics_node/loop/eye_sender.h"

#include <chrono>

#include "common/report/log.h"

namespace palpate::physics {
namespace {

constexpr auto again_period = std::chrono::milliseconds(33);
constexpr int most_refusals =
    100;  // of one chunk or page: some 20 s, by when DDS has given up a reader that does not answer

}  // namespace

EyeSender::EyeSender(Participant& participant, bool repeat)
    : surfaces_(participant), changes_(participant), blocks_(participant), repeat_(repeat), thread_([this] {
        send();
      }) {}

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
  std::erase_if(changes_due_, outdated);
  std::erase_if(blocks_due_, outdated);
  std::erase_if(sent_, outdated);
  revision_[chunk.body] = chunk.revision;
  begin_ahead(chunk.body);
  surfaces_due_[{chunk.body, chunk.chunk}] = std::make_unique<BodySurface>(chunk);
  something_.notify_one();
}

void EyeSender::post(const SurfaceChange& page) {
  const std::lock_guard lock(mutex_);
  begin_ahead(page.body);
  changes_due_[{page.body, page.page}] = std::make_unique<SurfaceChange>(page);
  something_.notify_one();
}

std::set<std::uint32_t> EyeSender::take_incomplete() {
  const std::lock_guard lock(mutex_);
  return std::exchange(incomplete_, {});
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

bool EyeSender::drain(std::chrono::milliseconds at_most) {
  std::unique_lock lock(mutex_);
  return nothing_left_.wait_for(lock, at_most, [this] {
    return waits_ && surfaces_due_.empty() && changes_due_.empty() && blocks_due_.empty();
  });
}

void EyeSender::send() {
  std::unique_lock lock(mutex_);
  auto next_again = std::chrono::steady_clock::now();
  while (!end_) {
    if (!surfaces_due_.empty()) {
      if (!send_ahead(surfaces_due_.begin()->first.first, lock)) send_surely(surfaces_due_, surfaces_, lock);
    } else if (!changes_due_.empty()) {
      if (!send_ahead(changes_due_.begin()->first.first, lock)) send_surely(changes_due_, changes_, lock);
    } else if (!blocks_due_.empty()) {
      send_block(blocks_due_.begin()->first, lock);
    } else {
      waits_ = true;
      nothing_left_.notify_all();
      something_.wait_for(lock, again_period);
      waits_ = false;
    }
    if (!repeat_ || std::chrono::steady_clock::now() < next_again) continue;
    send_again(lock);
    next_again = std::chrono::steady_clock::now() + again_period;
  }
}

/// The lock is open while DDS works. What DDS could not take comes again unless a newer one has come.
template <class M>
void EyeSender::send_surely(Due<M>& due, Writer<M>& writer, std::unique_lock<std::mutex>& lock) {
  auto node = due.extract(due.begin());
  const std::uint32_t body = node.key().first;
  lock.unlock();
  const bool sent = writer.write(*node.mapped());
  lock.lock();
  refusals_ = sent ? 0 : refusals_ + 1;
  if (sent) return;
  if (refusals_ >= most_refusals) {
    log_warn("a part of the surface of body {} could not be sent: it is sent whole again", body);
    incomplete_.insert(body);
    refusals_ = 0;
    return;
  }
  if (node.mapped()->revision >= revision_[body]) due.insert(std::move(node));
}

void EyeSender::begin_ahead(std::uint32_t body) {
  std::erase_if(ahead_, [body](const Key& key) { return key.first == body; });
}

/// A surface says where vertices lie at rest: a reader that knows already where they are never shows them there. Each
/// block goes ahead once, so that a slow network still takes surfaces. @return false: there is none to be sent ahead
bool EyeSender::send_ahead(std::uint32_t body, std::unique_lock<std::mutex>& lock) {
  for (auto due = blocks_due_.lower_bound({body, 0}); due != blocks_due_.end() && due->first.first == body;
       ++due) {
    if (!ahead_.insert(due->first).second) continue;
    send_block(due->first, lock);
    return true;
  }
  return false;
}

void EyeSender::send_block(Key which, std::unique_lock<std::mutex>& lock) {
  auto node = blocks_due_.extract(which);
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
