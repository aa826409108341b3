// How the arguments of a kernel are written on the host: a struct with a member for each parameter, in the
// kernel's order and by the kernel's names.
#pragma once

#include <cstdint>
#include <string_view>

#include "cl/program.h"
#include "kernels/shared/layout.h"
#include "wavefront/arguments_macro.h"
#include "wavefront/device_scene.h"

namespace whittle {

/// `__global T*`: a buffer, or a null pointer. The buffer must outlive the launch call.
template <typename T>
struct Global {
  const Buffer* buffer = nullptr;
  Global() = default;
  Global(const Buffer& b) : buffer(&b) {}
};

/// SCENE_PARAMS: the scene's buffers; without a scene null pointers and no triangle.
struct SceneArgument {
  const DeviceScene* scene = nullptr;
  SceneArgument() = default;
  SceneArgument(const DeviceScene& s) : scene(&s) {}
};

/// A type as kernels write it.
template <typename T>
inline constexpr std::string_view kKernelType = "";
template <>
inline constexpr std::string_view kKernelType<std::uint32_t> = "const uint";
template <>
inline constexpr std::string_view kKernelType<device::Batch> = "const Batch";
template <>
inline constexpr std::string_view kKernelType<device::DeviceCamera> = "const DeviceCamera";
template <>
inline constexpr std::string_view kKernelType<device::RenderConstants> = "const RenderConstants";
template <>
inline constexpr std::string_view kKernelType<SceneArgument> = "SCENE_PARAMS";
template <>
inline constexpr std::string_view kKernelType<Global<float>> = "__global float*";
template <>
inline constexpr std::string_view kKernelType<Global<const float>> = "__global const float*";
template <>
inline constexpr std::string_view kKernelType<Global<std::uint32_t>> = "__global uint*";
template <>
inline constexpr std::string_view kKernelType<Global<const std::uint32_t>> = "__global const uint*";
template <>
inline constexpr std::string_view kKernelType<Global<std::uint8_t>> = "__global uchar*";
template <>
inline constexpr std::string_view kKernelType<Global<const std::uint8_t>> = "__global const uchar*";

}  // namespace whittle
