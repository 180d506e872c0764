#pragma once
// What is made of a patient's image is as private as the image.

#include <sys/types.h>

#include <string>
#include <vector>

namespace palpate {

/// The rights that a file may not have which is made of these inputs: for each of group and others, all where
/// any input keeps them from reading, else to write where any keeps them from that. The group of an input
/// counts as ours only if it is, or if others may read it, too. A folder above an input that they may not search keeps
/// them from reading it. Inputs that are not there do not count.
mode_t withheld(const std::vector<std::string>& inputs);

/// From now on files of this process, and of those that it starts, have the rights of the narrowest of
/// `inputs` at most. Call it before other threads make files. Rights are only ever taken away.
void keep_as_private_as(const std::vector<std::string>& inputs);

}  // namespace palpate
