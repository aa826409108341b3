// See checkpoint_file.h.
#include "render/checkpoint_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>

#include "scene/hash.h"
#include "scene/input_error.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;
using FileBytes = std::vector<std::byte>;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

/// The last character before the newline is the version.
constexpr std::string_view kMagic = "Whittle state 1\n";
constexpr std::size_t kVersionAt = 14;

template <typename T>
void append(FileBytes& bytes, const T* values, std::size_t count) {
  const auto* const begin = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), begin, begin + count * sizeof(T));
}

/// Runs of neighbours: a picture's blocks are many, the gaps between those of a pass few.
Json runsOf(const std::vector<std::uint32_t>& blocks) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < blocks.size();) {
    std::size_t end = i + 1;
    while (end < blocks.size() && blocks[end] == blocks[end - 1] + 1) ++end;
    runs.push_back({blocks[i], end - i});
    i = end;
  }
  return runs;
}

std::vector<std::uint32_t> blocksOf(const Json& runs, std::size_t all) {
  std::vector<std::uint32_t> blocks;
  for (const Json& run : runs) {
    const auto first = run.at(0).get<std::uint64_t>(), count = run.at(1).get<std::uint64_t>();
    if (first >= all || count > all - first) throw std::out_of_range("a block beyond the picture");
    for (std::uint64_t b = first; b < first + count; ++b) blocks.push_back(static_cast<std::uint32_t>(b));
  }
  return blocks;
}

/// JSON has no infinity: null.
Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(); }
double orInfinity(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

Json errorToJson(const ErrorPoint& e) {
  return {{"seconds", e.seconds},
          {"raysPerPixel", e.raysPerPixel},
          {"estimate", finiteOrNull(e.estimate)},
          {"rmse", e.rmse ? finiteOrNull(*e.rmse) : Json()},
          {"mean", finiteOrNull(e.mean)}};
}

ErrorPoint errorOf(const Json& json) {
  ErrorPoint e;
  e.seconds = json.at("seconds").get<double>();
  e.raysPerPixel = json.at("raysPerPixel").get<double>();
  e.estimate = orInfinity(json.at("estimate"));
  if (!json.at("rmse").is_null()) e.rmse = json.at("rmse").get<double>();
  e.mean = orInfinity(json.at("mean"));
  return e;
}

Json headerOf(const Checkpoint& c) {
  const RenderState& s = c.state;
  Json pending = Json::array(), error = Json::array();
  for (const SamplePass& pass : s.pending)
    pending.push_back(
        {{"firstSample", pass.firstSample}, {"samples", pass.samples}, {"blocks", runsOf(pass.blocks)}});
  for (const ErrorPoint& point : s.error) error.push_back(errorToJson(point));
  return {{"identity", c.identity},
          {"arguments", c.arguments},
          {"folder", c.folder},
          {"device", s.device},
          {"blocks", s.counts.size()},
          {"film", s.film.size()},
          {"aovs", s.aovs.size()},
          {"pending", pending},
          {"rays",
           {{"primary", s.tally.primary},
            {"impulse", s.tally.impulse},
            {"shadow", s.tally.shadow},
            {"produced", s.tally.produced},
            {"finished", s.tally.finished},
            {"ended", s.tally.ended}}},
          {"nonFinite", s.nonFinite},
          {"endedShare", s.endedShare},
          {"seconds", s.seconds},
          {"error", error}};
}

/// The header's numbers; arrays get their sizes.
Checkpoint checkpointOf(const Json& json, std::uint64_t arrayBytes) {
  Checkpoint c;
  c.identity = json.at("identity");
  json.at("arguments").get_to(c.arguments);
  json.at("folder").get_to(c.folder);
  const auto blocks = json.at("blocks").get<std::uint64_t>(), film = json.at("film").get<std::uint64_t>(),
             aovs = json.at("aovs").get<std::uint64_t>();
  const std::uint64_t most = arrayBytes / sizeof(float);
  if (blocks > most || film > most || aovs > most || (blocks + film + aovs) * sizeof(float) != arrayBytes)
    throw std::out_of_range("arrays of other sizes");
  RenderState& s = c.state;
  s.counts.resize(blocks), s.film.resize(film), s.aovs.resize(aovs);
  for (const Json& pass : json.at("pending"))
    s.pending.push_back({pass.at("firstSample").get<std::uint32_t>(), pass.at("samples").get<std::uint32_t>(),
                         blocksOf(pass.at("blocks"), blocks)});
  json.at("device").get_to(s.device);
  const Json& rays = json.at("rays");
  rays.at("primary").get_to(s.tally.primary);
  rays.at("impulse").get_to(s.tally.impulse);
  rays.at("shadow").get_to(s.tally.shadow);
  rays.at("produced").get_to(s.tally.produced);
  rays.at("finished").get_to(s.tally.finished);
  rays.at("ended").get_to(s.tally.ended);
  json.at("nonFinite").get_to(s.nonFinite);
  json.at("endedShare").get_to(s.endedShare);
  json.at("seconds").get_to(s.seconds);
  for (const Json& point : json.at("error")) s.error.push_back(errorOf(point));
  return c;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(fmt::format("--resume: {}: {}", file.string(), why));
}

FileBytes readAll(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) refuse(file, "is no file");
  std::ifstream in(file, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (!in || error) refuse(file, "cannot be read");
  FileBytes bytes(size);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::uint64_t>(in.gcount()) != size) refuse(file, "cannot be read to its end");
  return bytes;
}

std::uint64_t numberAt(const FileBytes& bytes, std::size_t at) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

}  // namespace

void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  const std::string header = headerOf(checkpoint).dump(-1, ' ', false, Json::error_handler_t::replace);
  const RenderState& s = checkpoint.state;
  const std::uint64_t length = header.size();
  FileBytes bytes;
  bytes.reserve(kMagic.size() + 2 * sizeof(length) + length +
                sizeof(float) * (s.counts.size() + s.film.size() + s.aovs.size()));
  append(bytes, kMagic.data(), kMagic.size());
  append(bytes, &length, 1);
  append(bytes, header.data(), header.size());
  append(bytes, s.counts.data(), s.counts.size());
  append(bytes, s.film.data(), s.film.size());
  append(bytes, s.aovs.data(), s.aovs.size());
  const std::uint64_t hash = hashOf(bytes);
  append(bytes, &hash, 1);
  writeWholeFile(file, bytes);
}

Checkpoint readCheckpoint(const std::filesystem::path& file) {
  const FileBytes bytes = readAll(file);
  constexpr std::size_t kBegin = kMagic.size() + sizeof(std::uint64_t), kEnd = sizeof(std::uint64_t);
  if (bytes.size() < kMagic.size() || std::memcmp(bytes.data(), kMagic.data(), kVersionAt) != 0)
    refuse(file, "is no picture under way, as --checkpoint writes them");
  if (std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    refuse(file, "was written by another version of Whittle, in a form that this one does not read");
  if (bytes.size() < kBegin + kEnd ||
      hashOf(std::span(bytes).first(bytes.size() - kEnd)) != numberAt(bytes, bytes.size() - kEnd))
    refuse(file, "is cut off or damaged");
  const std::uint64_t rest = bytes.size() - kBegin - kEnd, length = numberAt(bytes, kMagic.size());
  if (length > rest) refuse(file, "is damaged: its header is longer than the file");
  try {
    const auto* const header = reinterpret_cast<const char*>(bytes.data()) + kBegin;
    Checkpoint c = checkpointOf(Json::parse(header, header + length), rest - length);
    const std::byte* from = bytes.data() + kBegin + length;
    const auto take = [&](auto& values) {
      const std::size_t size = values.size() * sizeof(values[0]);
      std::memcpy(values.data(), from, size);
      from += size;
    };
    take(c.state.counts), take(c.state.film), take(c.state.aovs);
    return c;
  } catch (const std::exception& e) {
    refuse(file, fmt::format("is damaged: {}", e.what()));
  }
}

}  // namespace whittle
