// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#pragma once

#include <span>
#include <string>

#include "entry_file.hpp"
#include "sweep.hpp"

namespace gnomon::tool {

/// What a study says of the files of a view.
struct ViewFiles {
  std::string hash;             ///< of its scenes, as rows have it; empty: any
  std::string licence, source;  ///< for people
  bool optional = false;        ///< the view is left out where a file is absent
};

/// A sweep, or a part of one, into a folder.
struct CompareRequest : SweepRequest {
  std::size_t shard = 0, shards = 1;  ///< of the rows, each `shards`-th from `shard` on
  double map_memory_mib = 0.0;        ///< that a technique's maps may take; 0: what there is
  double seconds = 0.0;               ///< no frame is begun that would last longer; 0: all are measured
  bool resume = false;                ///< rows that the folder has are not measured again
  std::vector<EntryWord> entries;     ///< techniques of others
  std::string capture;                ///< file whose cameras and sun are taken; empty: none
  bool write_masks = false;           ///< of each technique into the folder
  std::string exact;                  ///< folder of exact results; empty: beside the rows; none: keep nothing
  std::string view;                   ///< name in a study, for people
  ViewFiles files;                    ///< of the view
  std::string where;                  ///< file and view of a study, for messages

  [[nodiscard]] bool is_mine(std::uint64_t row) const noexcept { return row % shards == shard; }
};

/// Where it went.
struct Compared {
  std::size_t frames_left = 0;       ///< frames that time did not allow
  std::string rows, page;            ///< files; no page: one of several shards
  std::vector<std::string> refused;  ///< entries of others that are not measured, and why
};
/// Appends the rows of all requests, in their order, to `results.jsonl` in their folder, and writes the
/// report unless this is one of several shards. Folder, shard, context, memory and time are those of the
/// first, which there must be. Entries of others that do not fit are named, and all else is measured. Throws
/// std::runtime_error.
Compared compare(std::span<const CompareRequest> requests);

/// The options of the command line, bound to the request, which gets their defaults.
[[nodiscard]] std::vector<Option> compare_options(CompareRequest& request);

}  // namespace gnomon::tool
