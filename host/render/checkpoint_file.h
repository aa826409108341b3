// A picture under way as a file: what --checkpoint writes and --resume reads.
//
// Layout, all numbers little-endian: 16 bytes "Whittle state 1\n"; the length of the header, 8 bytes; the
// header, JSON; samples of each block of pixels (uint32); the film's planes (float32); those of the auxiliary
// outputs (float32); a hash (scene/hash.h) of all that, 8 bytes.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/render_state.h"

namespace whittle {

struct Checkpoint {
  /// All that decides on the picture's bits, by name: a render that goes on must have the same.
  nlohmann::ordered_json identity;
  std::vector<std::string> arguments;  ///< of the command that began, without the program's name
  std::string folder;                  ///< it ran there
  RenderState state;
};

/// Puts it at `file`, whole or not at all. Throws UnwritableFile.
void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws InputError, one line with the file's name, where it cannot be read, is no such file, of another
/// version, cut off or damaged. Takes no more memory than twice the file's size.
Checkpoint readCheckpoint(const std::filesystem::path& file);

}  // namespace whittle
