// See oiio_input.h.
#include "image/codec/oiio_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace whittle {
namespace {

namespace fs = std::filesystem;

OIIO::ImageSpec readHints() {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // premultiplying would lose colour where alpha is small
  return hints;
}

}  // namespace

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "no reason given" : text;
}

void refuseToDecode(const std::string& name, const std::string& why) {
  throw InputError(fmt::format("{}: cannot be decoded: {}", name, why));
}

void checkSize(int width, int height, int maxSide, const std::string& name) {
  if (width > maxSide || height > maxSide || std::int64_t{width} * height > kMaxImagePixels) {
    throw InputError(fmt::format("{}: {}x{} pixels are too many, at most {} a side and {} in all", name,
                                 width, height, maxSide, kMaxImagePixels));
  }
}

void checkSize(const OIIO::ImageSpec& spec, int maxSide, const std::string& name) {
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 || spec.deep) {
    throw InputError(fmt::format("{}: not a two-dimensional picture", name));
  }
  checkSize(spec.width, spec.height, maxSide, name);
}

std::unique_ptr<OIIO::ImageInput> openFile(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(fmt::format("{}: is a folder, not a picture", name));
  const int file = ::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0)
    throw InputError(fmt::format("{}: cannot be read: {}", name, std::generic_category().message(errno)));
  ::close(file);
  const OIIO::ImageSpec hints = readHints();
  auto input = OIIO::ImageInput::open(name, &hints);
  if (!input) throw InputError(fmt::format("{}: cannot be opened: {}", name, oneLine(OIIO::geterror())));
  return input;
}

std::vector<std::byte> readBytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::byte> bytes(fs::file_size(path));
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw InputError(fmt::format("{}: cannot be read", path.string()));
  }
  return bytes;
}

bool startsWith(std::span<const std::byte> bytes, std::size_t at, std::string_view magic) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

MemoryInput::MemoryInput(std::span<const std::byte> bytes, const char* format, const std::string& name)
    : memory_(bytes.data(), bytes.size()), input_(OIIO::ImageInput::create(format)) {
  if (!input_ || !input_->set_ioproxy(&memory_)) {
    throw InputError(fmt::format("{}: this OpenImageIO cannot decode {} from memory", name, format));
  }
  OIIO::ImageSpec spec;
  if (!input_->open(format, spec, readHints())) refuseToDecode(name, oneLine(input_->geterror()));
}

}  // namespace whittle
