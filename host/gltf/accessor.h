// glTF accessors to plain arrays (glTF 2.0, 3.6.2): strides, normalised integers, sparse overrides. All
// arithmetic is checked here, in 64 bits, against the bytes that are really there.
#pragma once

#include <cstdint>
#include <vector>

#include "gltf/document.h"

namespace whittle::gltf {

/// Nothing in the file backs the zeros of an accessor without a view, so the file's size does not bound them.
inline constexpr std::uint64_t kMostZeros = std::uint64_t{1} << 24;

const tinygltf::Accessor& accessorAt(const Document& document, int accessor);
int componentCount(const tinygltf::Accessor& accessor);
bool isFloat(const tinygltf::Accessor& accessor);
/// 8- or 16-bit integers, signed or not.
bool isSmallInteger(const tinygltf::Accessor& accessor);

/// All components of all elements as floats, normalised integers mapped to [-1, 1]
/// or [0, 1]. Throws InputError.
std::vector<float> readFloats(Document& document, int accessor);
/// The same for unsigned integers, as they are. The accessor must hold unsigned integers. Throws InputError.
std::vector<std::uint32_t> readUnsigned(Document& document, int accessor);

}  // namespace whittle::gltf
