#pragma once
// A process's membership of a DDS domain. Writers and readers hang on it and must go before it.

#include <cstdint>
#include <memory>
#include <string>

namespace palpate {

class Participant {
 public:
  /// Joins a domain.
  /// @param domain  0 to 100; processes meet only within one domain
  /// @param config  path of a Cyclone DDS configuration file; empty: the environment variable CYCLONEDDS_URI if a person
  ///                has set it, else this machine only (loopback_config.h)
  /// Participants of one process in one domain share the configuration of the first.
  /// @throws InputError if the configuration cannot be read, std::runtime_error if the domain cannot be joined
  explicit Participant(int domain, const std::string& config = "");
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  int domain() const noexcept { return domain_; }
  /// False when a person's configuration is used, or when the kernel refused to tie the sockets to loopback.
  bool local_only() const noexcept;
  std::int32_t handle() const noexcept { return handle_; }  // for common/wire only

 private:
  struct Domain;
  static std::shared_ptr<Domain> join(int domain, const std::string& config);

  int domain_;
  std::shared_ptr<Domain> shared_;
  std::int32_t handle_ = 0;
};

}  // namespace palpate
