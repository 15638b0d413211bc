// OGRE's maps as captures for `gnomon judge` and `gnomon compare --entry`.
#pragma once

#include <string>
#include <vector>

namespace peers {

/// Into a folder that is there: captures of the cases' two boxes, or with OGRE's maps in place of those of
/// other captures: the same cameras, sun and boxes. Returns the exit code: 1 where OGRE refused
/// one, which a line names. An OgreRoot must live.
int write_captures(const std::string& folder, const std::vector<std::string>& captures);

}  // namespace peers
