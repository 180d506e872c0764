#pragma once
// A process's membership of a DDS domain. Writers and readers hang on it and must go before it.

#include <cstdint>
#include <memory>
#include <string>

#include "common/wire/identity.h"
#include "common/wire/reach.h"

namespace palpate {

/// How a process joins a session.
struct Membership {
  int domain = 0;  // 0 to 100; processes meet only within one domain
  Reach reach;
  Identity identity;           // empty role: nobody in particular, as tools and tests are
  bool shared_memory = false;  // use it where RouDi is ready and nothing leaves this machine
};

class Participant {
 public:
  /// Joins a domain.
  /// @param domain  0 to 100; processes meet only within one domain
  /// @param config  path of a Cyclone DDS configuration file; empty: the environment variable CYCLONEDDS_URI if a person
  ///                has set it, else this machine only (loopback_config.h)
  /// Participants of one process in one domain share the configuration of the first.
  /// @throws InputError if the configuration cannot be read, std::runtime_error if the domain cannot be joined
  explicit Participant(int domain, const std::string& config = "");
  /// Joins as somebody, on this machine only or beyond it.
  /// @throws InputError if the reach names what is not there, or CYCLONEDDS_URI would replace it
  explicit Participant(const Membership& membership);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  int domain() const noexcept { return domain_; }
  /// False when a person's configuration is used, or when the kernel refused to tie the sockets to loopback.
  bool local_only() const noexcept;
  /// Vertex blocks go through RouDi's memory to those who use it, too. Decided by the first of a
  /// process's participants in a domain, once: a RouDi that comes later is not used.
  bool shared_memory() const noexcept;
  const Identity& identity() const noexcept { return identity_; }
  std::int32_t handle() const noexcept { return handle_; }  // for common/wire only

 private:
  struct Domain;
  Participant(const Membership& membership, const std::string& config);
  static std::shared_ptr<Domain> join(const Membership& membership, const std::string& config);

  void close_doors(Domain& shared, const Reach& reach) const;

  int domain_;
  Identity identity_;
  std::shared_ptr<Domain> shared_;
  std::int32_t handle_ = 0;
};

}  // namespace palpate
