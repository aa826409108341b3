// Reads accessors element by element, checked against the bytes that are there; sparse overrides last.
#include "gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace whittle::gltf {

namespace {

/// Elements in memory, checked: element i starts at data + i · stride. `data` is null for all zeros.
struct Run {
  const std::byte* data = nullptr;
  std::uint64_t stride = 0;
  std::uint64_t count = 0;
  int components = 1;
  int componentType = 0;
  bool normalized = false;
};

std::uint64_t componentBytes(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    default:
      return 4;
  }
}

template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);  // accessors in the wild are not always aligned
  return value;
}

/// Integers to floats as in glTF 2.0, 3.6.2.2 ("Accessor Data Types", the table of normalised integers).
float floatAt(const std::byte* at, int componentType, bool normalized) {
  const auto scaled = [normalized](auto value, float largest) {
    const auto number = static_cast<float>(value);
    return normalized ? std::max(number / largest, -1.0F) : number;
  };
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load<std::int8_t>(at), 127.0F);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(load<std::uint8_t>(at), 255.0F);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load<std::int16_t>(at), 32767.0F);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load<std::uint16_t>(at), 65535.0F);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return scaled(load<std::uint32_t>(at), 4294967295.0F);
    default:
      return load<float>(at);
  }
}

std::uint32_t unsignedAt(const std::byte* at, int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    default:
      return load<std::uint32_t>(at);
  }
}

/// `count` elements from `offset` on in a view. Offsets and counts are at most 2^53 and strides at most 252,
/// so nothing here overflows.
Run runIn(Document& document, int view, std::uint64_t offset, Run run, int accessor) {
  const auto data = viewData(document, view);
  const std::uint64_t elementBytes =
      componentBytes(run.componentType) * static_cast<std::uint64_t>(run.components);
  if (run.stride == 0) run.stride = elementBytes;
  if (run.stride < elementBytes) {
    document.fail(fmt::format("accessors[{}]: elements of {} bytes every {} bytes overlap", accessor,
                              elementBytes, run.stride));
  }
  if (run.count > 0) {
    const std::uint64_t end = offset + (run.count - 1) * run.stride + elementBytes;
    if (end > data.size()) {
      document.fail(fmt::format("accessors[{}] reaches beyond bufferViews[{}]: byte {} of {}", accessor, view,
                                end, data.size()));
    }
    run.data = data.data() + offset;
  }
  return run;
}

Run baseRun(Document& document, int index) {
  const tinygltf::Accessor& a = accessorAt(document, index);
  Run run{nullptr, 0, a.count, componentCount(a), a.componentType, a.normalized};
  if (const auto found = document.unpackedAccessors.find(index); found != document.unpackedAccessors.end()) {
    run.stride = componentBytes(a.componentType) * static_cast<std::uint64_t>(run.components);
    run.data = found->second.data();
    return run;
  }
  if (a.bufferView >= 0) {
    run.stride = document.model.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
    return runIn(document, a.bufferView, a.byteOffset, run, index);
  }
  if (run.count > kMostZeros) {
    document.fail(fmt::format("accessors[{}] has {} elements and no data", index, run.count));
  }
  return run;
}

/// The values of a run, which are about to be taken.
void passValues(Document& document, const Run& run, int accessor) {
  const std::uint64_t values = run.count * static_cast<std::uint64_t>(run.components);
  document.pass(values * sizeof(float), fmt::format("the {} values of accessors[{}]", values, accessor));
}

template <class T, class Convert>
void decode(const Run& run, std::vector<T>& out, Convert convert) {
  const auto components = static_cast<std::uint64_t>(run.components);
  out.assign(run.count * components, T{});
  if (!run.data) return;
  const std::uint64_t step = componentBytes(run.componentType);
  for (std::uint64_t i = 0; i < run.count; ++i) {
    const std::byte* element = run.data + i * run.stride;
    for (std::uint64_t c = 0; c < components; ++c) out[i * components + c] = convert(element + c * step);
  }
}

template <class T, class Convert>
void overrideSparse(Document& document, int index, std::vector<T>& out, Convert convert) {
  const tinygltf::Accessor& a = accessorAt(document, index);
  if (!a.sparse.isSparse) return;
  const auto count = static_cast<std::uint64_t>(a.sparse.count);
  Run indices{nullptr, 0, count, 1, a.sparse.indices.componentType, false};
  indices = runIn(document, a.sparse.indices.bufferView,
                  static_cast<std::uint64_t>(a.sparse.indices.byteOffset), indices, index);
  Run values{nullptr, 0, count, componentCount(a), a.componentType, a.normalized};
  values = runIn(document, a.sparse.values.bufferView, static_cast<std::uint64_t>(a.sparse.values.byteOffset),
                 values, index);
  const auto components = static_cast<std::uint64_t>(values.components);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t target = unsignedAt(indices.data + i * indices.stride, indices.componentType);
    if (target >= a.count) {
      document.fail(fmt::format("accessors[{}].sparse replaces element {} of {}", index, target, a.count));
    }
    const std::byte* element = values.data + i * values.stride;
    for (std::uint64_t c = 0; c < components; ++c) {
      out[target * components + c] = convert(element + c * componentBytes(values.componentType));
    }
  }
}

}  // namespace

const tinygltf::Accessor& accessorAt(const Document& document, int accessor) {
  return document.model.accessors[static_cast<std::size_t>(accessor)];
}

int componentCount(const tinygltf::Accessor& accessor) {
  return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
}

bool isFloat(const tinygltf::Accessor& accessor) {
  return accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

bool isSmallInteger(const tinygltf::Accessor& accessor) { return componentBytes(accessor.componentType) < 4; }

std::vector<float> readFloats(Document& document, int accessor) {
  const Run run = baseRun(document, accessor);
  passValues(document, run, accessor);
  const auto convert = [&run](const std::byte* at) { return floatAt(at, run.componentType, run.normalized); };
  std::vector<float> out;
  const auto floatBytes = static_cast<std::uint64_t>(run.components) * sizeof(float);
  if (run.data && run.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && run.stride == floatBytes) {
    out.resize(run.count * static_cast<std::uint64_t>(run.components));
    std::memcpy(out.data(), run.data, run.count * floatBytes);
  } else {
    decode(run, out, convert);
  }
  overrideSparse(document, accessor, out, convert);
  return out;
}

std::vector<std::uint32_t> readUnsigned(Document& document, int accessor) {
  const Run run = baseRun(document, accessor);
  passValues(document, run, accessor);
  const auto convert = [&run](const std::byte* at) { return unsignedAt(at, run.componentType); };
  std::vector<std::uint32_t> out;
  decode(run, out, convert);
  overrideSparse(document, accessor, out, convert);
  return out;
}

}  // namespace whittle::gltf
