#include "endowire/io/run_output.hpp"

#include <fmt/format.h>

#include <system_error>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"

namespace endowire::io {

namespace fs = std::filesystem;
using base::InputError;

namespace {

const char* const steps_folder = "steps";

/// Makes the folder, or clears it of an earlier run; returns the place of the recording.
fs::path make_ready(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / (vtp_available() ? steps_folder : ""), error);
  if (!fs::is_directory(folder, error))
    throw InputError(
        fmt::format("{}: cannot be made as a folder for the results", one_line(folder.string())));
  for (const char* name :
       {"summary.json", "report.html", "wire.vtp", "wire.pvd", "wire.svg", "vessel.stl", "recording.jsonl"})
    fs::remove(folder / name, error);
  std::vector<fs::path> old_steps;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / steps_folder, error))
    if (entry.path().extension() == ".vtp" && entry.path().filename().string().starts_with("wire_"))
      old_steps.push_back(entry.path());
  for (const fs::path& path : old_steps) fs::remove(path, error);
  return folder / "recording.jsonl";
}

}  // namespace

void check_output_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(fmt::format("--out: {} is a file; must be a folder", one_line(folder.string())));
}

RunOutput::RunOutput(fs::path folder, const RecordingHeader& header, sim::Access access)
    : folder_(std::move(folder)), access_(std::move(access)), recording_(make_ready(folder_), header) {
  written_.emplace_back("recording.jsonl");
}

void RunOutput::shape(std::uint64_t step, double time_s, const sim::Snapshot& snapshot) {
  if (!vtp_available() || snapshot.points.size() < 2) return;
  const std::string name = fmt::format("{}/wire_{:06d}.vtp", steps_folder, step);
  write_wire_vtp(folder_ / name, snapshot, access_);
  series_.push_back({time_s, name});
}

void RunOutput::waypoint(std::uint64_t step, int index, double time_s, const sim::Snapshot& snapshot) {
  if (!vtp_available() || snapshot.points.size() < 2) return;
  const std::string name = fmt::format("{}/wire_{:06d}_on_the_way_{:02d}.vtp", steps_folder, step, index + 1);
  write_wire_vtp(folder_ / name, snapshot, access_);
  series_.push_back({time_s, name});
}

void RunOutput::finish(std::uint64_t steps, const sim::Snapshot& last) {
  recording_.end(steps);
  if (!vtp_available()) return;
  if (!series_.empty()) written_.push_back(fmt::format("{}/wire_*.vtp", steps_folder));
  write_pvd(folder_ / "wire.pvd", series_);
  written_.emplace_back("wire.pvd");
  if (last.points.size() < 2) return;
  write_wire_vtp(folder_ / "wire.vtp", last, access_);
  written_.emplace_back("wire.vtp");
}

void RunOutput::file(const std::string& name, std::string_view bytes) {
  write_file_atomically(folder_ / name, bytes);
  written_.push_back(name);
}

}  // namespace endowire::io
