#include "endowire/io/recording.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/instrument_json.hpp"
#include "endowire/io/scene_file.hpp"

namespace endowire::io {

using base::InputError;
using nlohmann::json;

namespace {

constexpr std::uintmax_t max_recording_bytes = std::uintmax_t{1} << 30;  // ten million commands
constexpr double max_motion_rad = max_motion_deg * std::numbers::pi / 180.0;

// Bytes that are no UTF-8 (a path may hold any) must not stop a recording.
std::string dump(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::uint64_t hash_of(const json& value) {
  const std::string text = value.get<std::string>();
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError('"' + text + "\" is no hash");
  return hash;
}

RecordingHeader header_of(const json& value) {
  if (value.at("schema").get<int>() != 1)
    throw InputError(fmt::format("schema is {}; must be 1", value.at("schema").get<int>()));
  RecordingHeader header;
  header.version = value.at("version").get<std::string>();
  header.scene_name = value.at("scene").get<std::string>();
  header.scene_text = value.at("scene_text").get<std::string>();
  header.vessel = value.at("vessel").get<std::string>();
  header.vessel_hash = hash_of(value.at("vessel_hash"));
  header.instrument = instrument_from_json(value.at("instrument"));
  return header;
}

double bounded(const json& hand, const char* field, double limit) {
  const double value = hand.at(field).get<double>();
  if (!(std::abs(value) <= limit))
    throw InputError(fmt::format("{} is {}; must be between {} and {}", field, value, -limit, limit));
  return value;
}

void check_step(std::uint64_t step, std::uint64_t expected) {
  if (step != expected) throw InputError(fmt::format("step is {}; must be {}", step, expected));
}

RecordedCommand command_of(const json& value, const std::vector<RecordedCommand>& before) {
  const json& hands = value.at("hands");
  if (hands.size() != 1) throw InputError(fmt::format("hands is a list of {}; must be of 1", hands.size()));
  const json& hand = hands.at(0);
  RecordedCommand command;
  command.step = value.at("step").get<std::uint64_t>();
  command.time_s = value.at("time_s").get<double>();
  command.command = {bounded(hand, "advance_mm", max_motion_mm), bounded(hand, "torque_rad", max_motion_rad)};
  check_step(command.step, before.size() + 1);
  const double earlier_s = before.empty() ? 0.0 : before.back().time_s;
  if (!(command.time_s >= earlier_s))
    throw InputError(fmt::format("time_s is {}; must be >= {}", command.time_s, earlier_s));
  return command;
}

void read_line(const json& value, bool first, Recording& recording) {
  const std::string kind = value.at("kind").get<std::string>();
  if (first != (kind == "header"))
    throw InputError(first ? "the first line is no header" : "a second header");
  if (recording.complete) throw InputError("stands behind the end");
  if (kind == "header") {
    recording.header = header_of(value);
  } else if (kind == "command") {
    recording.commands.push_back(command_of(value, recording.commands));
  } else if (kind == "state") {
    const RecordedHash hash{value.at("step").get<std::uint64_t>(), hash_of(value.at("state_hash"))};
    check_step(hash.step, recording.commands.size());
    recording.hashes.push_back(hash);
  } else if (kind == "end") {
    check_step(value.at("steps").get<std::uint64_t>(), recording.commands.size());
    recording.complete = true;
  } else {
    throw InputError('"' + kind + "\" is no kind of line");
  }
}

}  // namespace

bool RecordingHeader::operator==(const RecordingHeader& other) const {
  return version == other.version && scene_name == other.scene_name && scene_text == other.scene_text &&
         vessel == other.vessel && vessel_hash == other.vessel_hash &&
         to_json(instrument) == to_json(other.instrument);
}

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header)
    : path_(path), out_(path, std::ios::binary | std::ios::trunc) {
  line(dump({{"kind", "header"},
             {"schema", 1},
             {"version", header.version},
             {"scene", header.scene_name},
             {"scene_text", header.scene_text},
             {"scene_hash", hash_text(content_hash(header.scene_text))},
             {"vessel", header.vessel},
             {"vessel_hash", hash_text(header.vessel_hash)},
             {"instrument", to_json(header.instrument)}}));
}

void RecordingWriter::command(const RecordedCommand& command) {
  const json hand = {{"advance_mm", command.command.advance_mm}, {"torque_rad", command.command.torque_rad}};
  line(dump({{"kind", "command"},
             {"step", command.step},
             {"time_s", command.time_s},
             {"hands", json::array({hand})}}));
}

void RecordingWriter::state(const RecordedHash& hash) {
  line(dump({{"kind", "state"}, {"step", hash.step}, {"state_hash", hash_text(hash.state_hash)}}));
}

void RecordingWriter::end(std::uint64_t steps) {
  line(dump({{"kind", "end"}, {"steps", steps}}));
}

void RecordingWriter::line(const std::string& text) {
  out_ << text << '\n' << std::flush;
  if (!out_) throw InputError(fmt::format("{}: cannot be written", one_line(path_.string())));
}

Recording parse_recording(const std::string& text, const std::string& name) {
  Recording recording;
  std::size_t start = 0;
  std::size_t number = 0;
  while (true) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string::npos) break;
    ++number;
    try {
      read_line(json::parse(text.begin() + static_cast<std::ptrdiff_t>(start),
                            text.begin() + static_cast<std::ptrdiff_t>(end)),
                number == 1, recording);
    } catch (const json::exception& error) {
      throw InputError(fmt::format("{}: line {}: {}", name, number, one_line(error.what())));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: line {}: {}", name, number, one_line(error.what())));
    }
    start = end + 1;
  }
  if (number == 0) throw InputError(fmt::format("{}: has no whole line; must begin with a header", name));
  return recording;
}

Recording read_recording(const std::filesystem::path& path) {
  return parse_recording(read_file(path, max_recording_bytes), one_line(path.string()));
}

}  // namespace endowire::io
