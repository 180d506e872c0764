#pragma once
// The strands of a connection as the eye sees them: a three-sided prism each, which is thinner the more of it has
// been cut, and a point once it no longer holds. To the eye a connection is one more body, numbered on behind those
// of the scene. It has no place at rest: its surface says where strands are when it is written.

#include <cstdint>
#include <functional>
#include <vector>

#include "common/message/messages.h"
#include "physics_node/connection/connection.h"

namespace palpate::physics {

class StrandPicture {
 public:
  /// @param connection  which outlives this  @param body  its number  @param rgba  0xAABBGGRR
  StrandPicture(const Connection& connection, std::uint32_t body, std::uint32_t rgba);

  bool is_due() const { return due_; }
  /// Writes the whole surface, if it is due. @param chunk  room for one @return chunks
  int write(BodySurface& chunk, const std::function<void(const BodySurface&)>& sink);
  void publish_anew();

  /// As MovedBlocks does. @param block  in which tick and t are filled in @return blocks
  int write_blocks(VertexBlock& block, const std::function<void(const VertexBlock&)>& sink);
  void resend();

  std::size_t n_facets() const { return facets_.size(); }

 private:
  void place();

  const Connection& connection_;
  std::uint32_t body_, revision_ = 1;
  bool due_ = true;
  std::vector<std::array<std::uint32_t, 4>> facets_;
  std::vector<std::uint32_t> rgba_;
  std::vector<Array3f> now_, sent_;  // of the vertices, six a strand [m]
};

}  // namespace palpate::physics
