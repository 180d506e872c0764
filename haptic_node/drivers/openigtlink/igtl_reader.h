#pragma once
// Poses out of a stream of OpenIGTLink messages, whose bytes may come in any pieces. Only TRANSFORM and POSITION are
// read; a tracker server may send anything else in between, also images.

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

namespace palpate::haptic::openigtlink {

struct TrackedPose {
  std::string name;                             // of the tool, as the server calls it
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  // [m]
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
};

class IgtlReader {
 public:
  /// What has come over the wire.
  void take(const std::string& bytes);

  /// The next pose that is complete, or nothing.
  std::optional<TrackedPose> next();

  std::uint64_t damaged() const noexcept { return damaged_; }  // messages with a wrong check sum or content

 private:
  std::optional<TrackedPose> read_body(const std::string& message);
  std::string input_;
  std::uint64_t to_skip_ = 0;  // of a message that is not for us [bytes]
  std::uint64_t damaged_ = 0;
};

}  // namespace palpate::haptic::openigtlink
