// Numbers of bytes as people write and read them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace whittle {

/// "12.5 MB", for people.
std::string formatBytes(std::uint64_t bytes);

/// "500M", "4G", "1.5 GB", "512MiB", "800000": decimal, unless an i says otherwise. Nothing where it is no
/// such number, or one below 1 or beyond 2^53.
std::optional<std::uint64_t> parseBytes(std::string_view text);

}  // namespace whittle
