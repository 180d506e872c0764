#include "haptic_node/drivers/openigtlink/igtl_reader.h"

#include <igtlMessageHeader.h>
#include <igtlPositionMessage.h>
#include <igtlTransformMessage.h>
#include <igtl_header.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace palpate::haptic::openigtlink {
namespace {

constexpr double mm = 1e-3;                   // [m]
constexpr std::uint64_t largest_pose = 4096;  // a body with extended header and remarks [bytes]
constexpr double orthonormal_within = 1e-3;

igtl::MessageHeader::Pointer header_of(const std::string& bytes) {
  auto header = igtl::MessageHeader::New();
  header->InitPack();
  std::memcpy(header->GetPackPointer(), bytes.data(), std::min<std::size_t>(bytes.size(), IGTL_HEADER_SIZE));
  header->Unpack();
  return header;
}

/// Fills `message` with what came. @return false if the check sum is wrong
template <class Message>
bool unpack(Message& message, const igtl::MessageHeader::Pointer& header, const std::string& bytes) {
  message->SetMessageHeader(header);
  message->AllocatePack();
  const auto room = static_cast<std::size_t>(message->GetPackBodySize());
  if (bytes.size() - IGTL_HEADER_SIZE != room) return false;
  std::memcpy(message->GetPackBodyPointer(), bytes.data() + IGTL_HEADER_SIZE, room);
  return (message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY) != 0;
}

bool is_pose(const TrackedPose& pose) {
  return pose.p.allFinite() && pose.r.allFinite() && pose.r.determinant() > 0 &&
         (pose.r * pose.r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <
             orthonormal_within;
}

}  // namespace

void IgtlReader::take(const std::string& bytes) { input_ += bytes; }

std::optional<TrackedPose> IgtlReader::next() {
  while (true) {
    const std::size_t skipped = static_cast<std::size_t>(std::min<std::uint64_t>(to_skip_, input_.size()));
    input_.erase(0, skipped);
    to_skip_ -= skipped;
    if (to_skip_ > 0 || input_.size() < IGTL_HEADER_SIZE) return {};
    const auto header = header_of(input_);
    const std::string type = header->GetDeviceType();
    const auto body = static_cast<std::uint64_t>(header->GetBodySizeToRead());
    if ((type != "TRANSFORM" && type != "POSITION") || body > largest_pose) {
      to_skip_ = IGTL_HEADER_SIZE + body;
      continue;
    }
    const std::size_t whole = IGTL_HEADER_SIZE + static_cast<std::size_t>(body);
    if (input_.size() < whole) return {};
    const auto pose = read_body(input_.substr(0, whole));
    input_.erase(0, whole);
    if (pose) return pose;
    ++damaged_;
  }
}

std::optional<TrackedPose> IgtlReader::read_body(const std::string& message) {
  const auto header = header_of(message);
  TrackedPose pose;
  pose.name = header->GetDeviceName();
  if (std::string(header->GetDeviceType()) == "TRANSFORM") {
    auto transform = igtl::TransformMessage::New();
    if (!unpack(transform, header, message)) return {};
    igtl::Matrix4x4 m;  // rows, the last column the position [mm]
    transform->GetMatrix(m);
    for (int i = 0; i < 3; ++i) {
      pose.p[i] = static_cast<double>(m[i][3]) * mm;
      for (int j = 0; j < 3; ++j) pose.r(i, j) = static_cast<double>(m[i][j]);
    }
  } else {
    auto position = igtl::PositionMessage::New();
    if (!unpack(position, header, message)) return {};
    float p[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1};
    position->GetPosition(p);
    position->GetQuaternion(q);
    for (int i = 0; i < 3; ++i) pose.p[i] = static_cast<double>(p[i]) * mm;
    const Eigen::Quaternion<float> turn(q[3], q[0], q[1], q[2]);
    if (std::abs(turn.norm() - 1.0f) > 1e-3f) return {};
    pose.r = turn.cast<double>().normalized().toRotationMatrix();
  }
  if (!is_pose(pose)) return {};
  return pose;
}

}  // namespace palpate::haptic::openigtlink
