// Device listing and choice. The device is asked for what it can do; nothing is guessed from its name.
#include "cl/device.h"

#include <pthread.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "cl/error.h"

namespace whittle {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string kindOf(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_CPU) return "cpu";
  if (type & CL_DEVICE_TYPE_GPU) return "gpu";
  if (type & CL_DEVICE_TYPE_ACCELERATOR) return "accelerator";
  return "other";
}

/// Drivers that read from the environment how many threads they may start, when they are loaded.
struct Driver {
  const char* name;  ///< in that of its platform or device
  const char* threads;
};
constexpr std::array kDrivers{Driver{"Portable Computing Language", "POCL_MAX_PTHREAD_COUNT"},
                              Driver{"llvmpipe", "LP_NUM_THREADS"}};

std::string whyUnusable(const cl::Device& device) {
  if (!device.getInfo<CL_DEVICE_AVAILABLE>()) return "the driver says it is not available";
  if (!device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) return "it has no kernel compiler";
  if (!device.getInfo<CL_DEVICE_ENDIAN_LITTLE>()) return "it is big-endian";
  const auto version = device.getInfo<CL_DEVICE_VERSION>();  // "OpenCL 1.2 …"
  if (version.rfind("OpenCL 1.0", 0) == 0 || version.rfind("OpenCL 1.1", 0) == 0)
    return "it knows only " + version;
  return {};
}

DeviceInfo describe(const cl::Device& device, const std::string& platform) {
  DeviceInfo info;
  info.device = device;
  info.platform = platform;
  info.name = device.getInfo<CL_DEVICE_NAME>();
  info.vendor = device.getInfo<CL_DEVICE_VENDOR>();
  info.version = device.getInfo<CL_DEVICE_VERSION>();
  info.driver = device.getInfo<CL_DRIVER_VERSION>();
  info.kind = kindOf(device.getInfo<CL_DEVICE_TYPE>());
  info.computeUnits = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.globalMemory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.largestBuffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.maxWorkGroup = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  info.floatLanes = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
  info.sharesMemory = info.kind == "cpu" && device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>();
  info.reason = whyUnusable(device);
  info.usable = info.reason.empty();
  return info;
}

/// PoCL has a device on every CPU, unless it finds no folder for its compiled kernels.
std::string noDevice(const std::string& platform) {
  const bool pocl = platform.find("Portable Computing Language") != std::string::npos;
  return platform + ": no device" +
         (pocl ? "; PoCL needs a folder that it can write to: set HOME, XDG_CACHE_HOME or POCL_CACHE_DIR to "
                 "one"
               : "");
}

void listPlatform(const cl::Platform& platform, DeviceList& list) {
  std::string name = "a platform";
  try {
    name = platform.getInfo<CL_PLATFORM_NAME>();
    std::vector<cl::Device> devices;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    for (const auto& device : devices) {
      try {
        list.devices.push_back(describe(device, name));
      } catch (const cl::Error& e) {
        list.problems.push_back(name + ": a device does not answer (" + clErrorName(e.err()) + ")");
      }
    }
    if (devices.empty()) list.problems.push_back(noDevice(name));
  } catch (const cl::Error& e) {
    list.problems.push_back(e.err() == CL_DEVICE_NOT_FOUND ? noDevice(name)
                                                           : name + ": " + clErrorName(e.err()));
  }
}

const DeviceInfo* find(const DeviceList& list, const std::string& selector) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(selector.data(), selector.data() + selector.size(), index);
  if (error == std::errc{} && end == selector.data() + selector.size())
    return index < list.devices.size() ? &list.devices[index] : nullptr;
  const std::string wanted = lower(selector);
  const DeviceInfo* first = nullptr;
  for (const auto& d : list.devices) {
    const bool matches = wanted.empty() || d.kind == wanted ||
                         lower(d.name).find(wanted) != std::string::npos ||
                         lower(d.platform).find(wanted) != std::string::npos;
    if (!matches) continue;
    if (wanted.empty() && d.usable && d.kind == "cpu") return &d;
    if (!first || (!first->usable && d.usable)) first = &d;
  }
  return first;
}

}  // namespace

DeviceList listDevices() {
  DeviceList list;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error& e) {
    list.problems.push_back("no OpenCL platform (" + clErrorName(e.err()) +
                            "); install one, for instance PoCL");
  }
  for (const auto& platform : platforms) listPlatform(platform, list);
  for (std::size_t i = 0; i < list.devices.size(); ++i) list.devices[i].index = static_cast<int>(i);
  return list;
}

DeviceInfo selectDevice(const DeviceList& list, const std::string& selector) {
  const DeviceInfo* found = find(list, selector);
  if (!found) {
    const std::string what =
        selector.empty() ? "no OpenCL device" : "no OpenCL device matches '" + selector + "'";
    throw std::invalid_argument("--device: " + what + "; `whittle devices` lists what is there");
  }
  if (!found->usable)
    throw std::invalid_argument("--device: " + found->name + " cannot be used: " + found->reason);
  return *found;
}

DeviceInfo withThreads(DeviceInfo info, int threads) {
  if (threads <= 0 || info.kind != "cpu" || static_cast<unsigned>(threads) >= info.computeUnits) return info;
  return clTry("dividing " + info.name, [&] {
    const auto ways = info.device.getInfo<CL_DEVICE_PARTITION_PROPERTIES>();
    if (std::find(ways.begin(), ways.end(), CL_DEVICE_PARTITION_BY_COUNTS) == ways.end()) return info;
    const std::array<cl_device_partition_property, 4> wanted{CL_DEVICE_PARTITION_BY_COUNTS, threads,
                                                             CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    std::vector<cl::Device> parts;
    info.device.createSubDevices(wanted.data(), &parts);
    info.device = parts.at(0);
    info.computeUnits = static_cast<unsigned>(threads);
    return info;
  });
}

unsigned processorsOf(const DeviceInfo& device) {
  const unsigned here = std::thread::hardware_concurrency();
  return device.kind == "cpu" && here > 0 ? std::min(here, device.computeUnits) : device.computeUnits;
}

bool keepsToThreads(const DeviceInfo& device, int threads) {
  if (device.computeUnits <= static_cast<unsigned>(threads)) return true;
  for (const Driver& driver : kDrivers) {
    const char* const told = std::getenv(driver.threads);
    if (told && told == std::to_string(threads) &&
        (device.platform + device.name).find(driver.name) != std::string::npos)
      return true;
  }
  return processorsOf(device) <= static_cast<unsigned>(threads);
}

void prepareCpuThreads(int threads, int workGroup) {
  for (const Driver& driver : kDrivers)
    if (threads > 0) setenv(driver.threads, std::to_string(threads).c_str(), 1);
  // PoCL keeps the private variables of all items of a group on the stack of the thread that runs it, and
  // says 1024 bytes an item (CL_KERNEL_PRIVATE_MEM_SIZE) whatever they are. Ours have 2.4 kB; most of this is
  // only addresses. Compilers like the 8 MB that threads mostly have.
  constexpr std::size_t kItem = 16 << 10, kBesides = 1 << 20, kUsual = 8 << 20;
  const std::size_t wanted =
      std::max(kUsual, kBesides + kItem * static_cast<std::size_t>(std::max(workGroup, 0)));
  pthread_attr_t attributes;
  std::size_t now = 0;
  if (pthread_getattr_default_np(&attributes) != 0) return;
  if (pthread_attr_getstacksize(&attributes, &now) == 0 && now < wanted &&
      pthread_attr_setstacksize(&attributes, wanted) == 0)
    pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

}  // namespace whittle
